#include "window/editor/overlay.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "window/interface.h"

namespace shoal::window {

namespace {

constexpr float vertexReach = 9, springReach = 6;  // points from the pointer

float cross(ImVec2 a, ImVec2 b) {
    return a.x * b.y - a.y * b.x;
}
ImVec2 minus(ImVec2 a, ImVec2 b) {
    return {a.x - b.x, a.y - b.y};
}

float distanceTo(ImVec2 p, ImVec2 a, ImVec2 b) {
    const ImVec2 ab = minus(b, a), ap = minus(p, a);
    const float length = ab.x * ab.x + ab.y * ab.y;
    const float t = length > 0 ? std::clamp((ap.x * ab.x + ap.y * ab.y) / length, 0.0f, 1.0f) : 0.0f;
    return std::hypot(ap.x - t * ab.x, ap.y - t * ab.y);
}

ImU32 rgb(float r, float g, float b, float opacity) {
    return ImGui::ColorConvertFloat4ToU32(ImVec4(r, g, b, opacity));
}

}  // namespace

ImU32 strainColor(double share, float opacity) {
    const float t = float(std::clamp(share, -1.0, 1.0));
    const float s = std::abs(t);
    const float slack[3] = {0.55f, 0.78f, 0.42f};
    const float end[3] = {t > 0 ? 1.0f : 0.25f, t > 0 ? 0.30f : 0.55f, t > 0 ? 0.22f : 1.0f};
    return rgb(slack[0] + (end[0] - slack[0]) * s, slack[1] + (end[1] - slack[1]) * s,
               slack[2] + (end[2] - slack[2]) * s, opacity);
}

namespace {

// Draws one molecule; everything further from the eye a little fainter.
class Painter {
  public:
    Painter(const Molecule& molecule, const std::vector<glm::dvec3>& positions, const Projector& projector,
            const EditorOverlay& overlay)
        : m_(molecule), x_(positions), projector_(projector), overlay_(overlay) {
        list_ = ImGui::GetBackgroundDrawList();
        for (const glm::dvec3& x : x_) {
            places_.push_back(projector.place(x));
            nearest_ = std::min(nearest_, projector.depth(x));
            furthest_ = std::max(furthest_, projector.depth(x));
        }
    }

    void triangles() {
        for (size_t i = 0; i < m_.triangles.size(); ++i) {
            const Triangle& t = m_.triangles[i];
            const auto &a = places_[size_t(t.a)], &b = places_[size_t(t.b)], &c = places_[size_t(t.c)];
            if (!a || !b || !c) continue;
            const bool selected = overlay_.selection.triangles.contains(int(i));
            const bool marked = overlay_.markedTriangles.contains(int(i));
            const bool hovered = overlay_.hoveredTriangle == int(i);
            if (!selected && !marked && !hovered) continue;
            list_->AddTriangleFilled(
                *a, *b, *c,
                marked ? rgb(1, 0.6f, 0.1f, 0.35f) : rgb(1, 0.85f, 0.3f, selected ? 0.35f : 0.15f));
        }
        if (overlay_.normals) normals();
    }

    void springs(const std::vector<double>& strains) {
        for (size_t i = 0; i < m_.springs.size(); ++i) {
            const Spring& s = m_.springs[i];
            const auto &a = places_[size_t(s.a)], &b = places_[size_t(s.b)];
            if (!a || !b) continue;
            const double deep = (projector_.depth(x_[size_t(s.a)]) + projector_.depth(x_[size_t(s.b)])) / 2;
            const float fade = fadeAt(deep);
            ImU32 color = rgb(0.62f, 0.72f, 0.62f, 0.8f * fade);
            if (overlay_.tension && i < strains.size())
                color = strainColor(strains[i] / overlay_.strainShown, 0.9f * fade);
            if (overlay_.markedSprings.contains(int(i)))
                list_->AddLine(*a, *b, rgb(1, 0.6f, 0.1f, 0.8f), points(5));
            const bool selected = overlay_.selection.springs.contains(int(i));
            if (selected || overlay_.hoveredSpring == int(i))
                list_->AddLine(*a, *b, rgb(1, 0.85f, 0.3f, selected ? 0.9f : 0.5f), points(5));
            list_->AddLine(*a, *b, color, points(1.6f));
            if (s.actuation && s.actuation->amplitude > 0) {  // a muscle has a bead
                const ImVec2 middle((a->x + b->x) / 2, (a->y + b->y) / 2);
                list_->AddCircleFilled(middle, points(3), color);
            }
        }
    }

    void vertices() {
        for (size_t v = 0; v < places_.size(); ++v) {
            if (!places_[v]) continue;
            const ImVec2 p = *places_[v];
            const float fade = fadeAt(projector_.depth(x_[v]));
            const bool selected = overlay_.selection.vertices.contains(int(v));
            const float size = points(selected ? 5.5f : 4.5f);
            if (overlay_.marked.contains(int(v)))
                list_->AddCircle(p, points(10), rgb(1, 0.6f, 0.1f, 1), 0, points(2));
            if (overlay_.hoveredVertex == int(v))
                list_->AddCircle(p, points(8), rgb(1, 0.9f, 0.5f, 0.9f), 0, points(1.5f));
            const ImU32 fill = selected ? rgb(1, 0.85f, 0.3f, 1) : rgb(0.92f, 0.96f, 0.9f, fade);
            if (m_.vertices[v].pinned) {  // a square
                list_->AddRectFilled({p.x - size, p.y - size}, {p.x + size, p.y + size},
                                     selected ? fill : rgb(1, 0.5f, 0.35f, std::max(0.8f, fade)));
            } else {
                list_->AddCircleFilled(p, size, fill);
            }
            if (!overlay_.numbers && !selected && overlay_.hoveredVertex != int(v)) continue;
            const std::string number = std::to_string(v);
            list_->AddText({p.x + points(7), p.y - points(14)}, rgb(1, 1, 1, 0.9f), number.c_str());
        }
    }

    void chain() {
        std::vector<ImVec2> line;
        for (const int v : overlay_.chain)
            if (size_t(v) < places_.size() && places_[size_t(v)]) line.push_back(*places_[size_t(v)]);
        if (line.empty()) return;
        if (overlay_.chainEnd) line.push_back(*overlay_.chainEnd);
        for (size_t i = 0; i + 1 < line.size(); ++i)
            list_->AddLine(line[i], line[i + 1], rgb(1, 0.85f, 0.3f, 0.9f), points(2));
    }

  private:
    float fadeAt(double depth) const {
        const double range = std::max(furthest_ - nearest_, 1e-9);
        return float(1 - 0.55 * std::clamp((depth - nearest_) / range, 0.0, 1.0));
    }

    void normals() {
        const double size = 0.08 * m_.size();
        for (const Triangle& t : m_.triangles) {
            const glm::dvec3 &a = x_[size_t(t.a)], &b = x_[size_t(t.b)], &c = x_[size_t(t.c)];
            const glm::dvec3 n = glm::cross(b - a, c - a);
            if (glm::length(n) < 1e-30) continue;
            const glm::dvec3 middle = (a + b + c) / 3.0;
            const auto from = projector_.place(middle),
                       to = projector_.place(middle + glm::normalize(n) * size);
            if (!from || !to) continue;
            list_->AddLine(*from, *to, rgb(0.4f, 0.75f, 1, 0.9f), points(1.5f));
            list_->AddCircleFilled(*to, points(2), rgb(0.4f, 0.75f, 1, 0.9f));
        }
    }

    const Molecule& m_;
    const std::vector<glm::dvec3>& x_;
    const Projector& projector_;
    const EditorOverlay& overlay_;
    ImDrawList* list_;
    std::vector<std::optional<ImVec2>> places_;
    double nearest_ = 1e300, furthest_ = -1e300;
};

// The plane of symmetry as a frame around the molecule.
void drawMirror(const Molecule& molecule, const Projector& projector, int axis) {
    const Box box = boxAround(molecule);
    const double room = 0.1 * molecule.size();
    const glm::dvec3 low = box.low - room, high = box.high + room;
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    std::optional<ImVec2> corners[4];
    for (int i = 0; i < 4; ++i) {
        glm::dvec3 corner(0);
        corner[p] = i == 0 || i == 3 ? low[p] : high[p];
        corner[q] = i < 2 ? low[q] : high[q];
        corners[i] = projector.place(corner);
    }
    for (int i = 0; i < 4; ++i)
        if (corners[i] && corners[(i + 1) % 4])
            list->AddLine(*corners[i], *corners[(i + 1) % 4], rgb(0.5f, 0.8f, 1, 0.5f), points(1));
}

// The first of some elements by what `measure` gives; nothing of those that are out of reach.
template <typename Measure>
std::optional<int> firstOf(size_t count, const Measure& measure) {
    std::optional<int> best;
    double least = 1e300;
    for (size_t i = 0; i < count; ++i) {
        const std::optional<double> measured = measure(i);
        if (measured && *measured < least) least = *measured, best = int(i);
    }
    return best;
}

}  // namespace

Box boxAround(const Molecule& molecule) {
    Box out{glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (const Vertex& vertex : molecule.vertices) {
        out.low = glm::min(out.low, vertex.position);
        out.high = glm::max(out.high, vertex.position);
    }
    return out;
}

void drawOverlay(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                 const std::vector<double>& strains, const Projector& projector,
                 const EditorOverlay& overlay) {
    if (positions.size() != molecule.vertices.size()) return;
    if (overlay.mirrorAxis >= 0) drawMirror(molecule, projector, overlay.mirrorAxis);
    Painter painter(molecule, positions, projector, overlay);
    painter.triangles();
    if (overlay.springs) painter.springs(strains);
    painter.chain();
    if (overlay.vertices) painter.vertices();
}

std::optional<int> vertexAt(const std::vector<glm::dvec3>& positions, const Projector& projector,
                            ImVec2 place) {
    return firstOf(positions.size(), [&](size_t v) -> std::optional<double> {
        const auto p = projector.place(positions[v]);
        if (!p || std::hypot(p->x - place.x, p->y - place.y) > points(vertexReach)) return {};
        return projector.depth(positions[v]);  // of those within reach, what lies in front
    });
}

std::optional<int> springAt(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                            const Projector& projector, ImVec2 place) {
    return firstOf(molecule.springs.size(), [&](size_t i) -> std::optional<double> {
        const auto a = projector.place(positions[size_t(molecule.springs[i].a)]),
                   b = projector.place(positions[size_t(molecule.springs[i].b)]);
        if (!a || !b) return {};
        const float distance = distanceTo(place, *a, *b);
        return distance < points(springReach) ? std::optional(double(distance)) : std::nullopt;
    });
}

std::optional<int> triangleAt(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                              const Projector& projector, ImVec2 place) {
    return firstOf(molecule.triangles.size(), [&](size_t i) -> std::optional<double> {
        const Triangle& t = molecule.triangles[i];
        const glm::dvec3 &x = positions[size_t(t.a)], &y = positions[size_t(t.b)],
                         &z = positions[size_t(t.c)];
        const auto a = projector.place(x), b = projector.place(y), c = projector.place(z);
        if (!a || !b || !c) return {};
        const float s0 = cross(minus(*b, *a), minus(place, *a)), s1 = cross(minus(*c, *b), minus(place, *b)),
                    s2 = cross(minus(*a, *c), minus(place, *c));
        if (!((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0))) return {};
        return projector.depth((x + y + z) / 3.0);
    });
}

}  // namespace shoal::window
