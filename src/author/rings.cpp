// Rings across the body, as of the molecule "fish": sides right, top, left, bottom, from the snout back.
#include <algorithm>
#include <cmath>
#include <utility>

#include "author/coarse.h"
#include "core/error.h"

namespace shoal {

namespace {

// The box's axes: `along` the longest, `up` Y where that is another, `side` = up x along.
struct Axes {
    int along = 2, up = 1, side = 0;

    explicit Axes(const glm::dvec3& extent) {
        for (int axis = 0; axis < 3; ++axis)
            if (extent[axis] > extent[along]) along = axis;
        up = along == 1 ? 2 : 1;
        side = 3 - along - up;
    }
    // +1 or -1: of `side`, so that side, up, along are right-handed.
    double sign() const { return (side + 1) % 3 == up ? 1 : -1; }
};

// Extents of the section at `place` along the axis, of every edge that crosses it.
struct Section {
    glm::dvec2 low{1e300}, high{-1e300};
    std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;  // its outline
    bool any() const { return low.x <= high.x; }
    void add(const std::vector<glm::dvec2>& ends) {
        for (const glm::dvec2& p : ends)
            low = glm::min(low, p), high = glm::max(high, p);
        if (ends.size() == 2) lines.emplace_back(glm::min(ends[0], ends[1]), glm::max(ends[0], ends[1]));
    }
    // Whether no line across it misses the outline: it is of one part.
    bool whole() {
        for (int axis = 0; axis < 2; ++axis) {
            std::sort(lines.begin(), lines.end(),
                      [&](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
            double covered = low[axis];
            for (const auto& [from, to] : lines) {
                if (from[axis] > covered + 1e-6 * (high[axis] - low[axis])) return false;
                covered = std::max(covered, to[axis]);
            }
        }
        return any();
    }
};

Section sectionAt(const Mesh& mesh, const Axes& axes, double place) {
    Section out;
    for (const glm::ivec3& t : mesh.triangles) {
        std::vector<glm::dvec2> ends;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 a = mesh.positions[size_t(t[i])], b = mesh.positions[size_t(t[(i + 1) % 3])];
            const double from = a[axes.along] - place, to = b[axes.along] - place;
            if ((from > 0) == (to > 0)) continue;
            const glm::dvec3 p = a + (b - a) * (from / (from - to));
            ends.emplace_back(axes.sign() * p[axes.side], p[axes.up]);
        }
        out.add(ends);
    }
    return out;
}

constexpr double inset = 0.03;  // of the ends, where sections vanish

}  // namespace

bool holdsRings(const Mesh& mesh) {
    const Axes axes(mesh.high - mesh.low);
    constexpr int sections = 24;
    for (int i = 0; i < sections; ++i) {
        const double share = std::lerp(inset, 1 - inset, double(i) / (sections - 1));
        if (!sectionAt(mesh, axes, std::lerp(mesh.low[axes.along], mesh.high[axes.along], share)).whole())
            return false;
    }
    return true;
}

CoarseMesh ringsOf(const Mesh& mesh, int rings) {
    const glm::dvec3 extent = mesh.high - mesh.low;
    const Axes axes(extent);
    const double length = extent[axes.along];
    if (!(std::min({extent.x, extent.y, extent.z}) > 1e-3 * length))
        throw Error("rings go around a body; this mesh is flat");
    constexpr double least = 0.2;  // half a ring's width by the widest
    CoarseMesh out;
    const glm::dvec2 floor = 0.5 * least * glm::dvec2(extent[axes.side], extent[axes.up]);
    for (int ring = 0; ring < rings; ++ring) {
        const double share = inset + (1 - 2 * inset) * ring / (rings - 1);
        const double place = mesh.high[axes.along] - share * length;
        const Section section = sectionAt(mesh, axes, place);
        glm::dvec2 middle(axes.sign() * 0.5 * (mesh.low + mesh.high)[axes.side],
                          0.5 * (mesh.low + mesh.high)[axes.up]);
        glm::dvec2 half(0);
        if (section.any())
            middle = 0.5 * (section.low + section.high), half = 0.5 * (section.high - section.low);
        half = glm::max(half, floor);
        const glm::dvec2 corners[] = {{half.x, 0}, {0, half.y}, {-half.x, 0}, {0, -half.y}};
        for (int side = 0; side < 4; ++side) {
            glm::dvec3 p(0);
            p[axes.along] = place;
            p[axes.side] = axes.sign() * (middle.x + corners[side].x);
            p[axes.up] = middle.y + corners[side].y;
            out.positions.push_back(p);
            const int here = 4 * ring + side, beside = 4 * ring + (side + 1) % 4;
            if (ring + 1 == rings) continue;
            out.triangles.push_back({here, here + 4, beside});
            out.triangles.push_back({beside, here + 4, beside + 4});
        }
    }
    const int last = 4 * (rings - 1);
    for (const glm::ivec3& cap : {glm::ivec3(0, 1, 2), glm::ivec3(0, 2, 3),
                                  glm::ivec3(last, last + 2, last + 1), glm::ivec3(last, last + 3, last + 2)})
        out.triangles.push_back(cap);
    return out;
}

}  // namespace shoal
