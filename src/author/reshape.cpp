// Edits of a whole shape: one side as the image of the other, finer triangles, masses by area.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "author/edit.h"

namespace shoal {

namespace {

// m^2.
double areaOf(const Molecule& molecule, const Triangle& t) {
    const auto position = [&](int v) { return molecule.vertices[size_t(v)].position; };
    return 0.5 * glm::length(glm::cross(position(t.b) - position(t.a), position(t.c) - position(t.a)));
}

// Adds a vertex, or a spring, that is new to the file.
int add(Draft& draft, const Vertex& vertex) {
    const int out = addVertex(draft, vertex.position);
    draft.molecule.vertices.back() = vertex;
    return out;
}
void add(Draft& draft, const Spring& like, int a, int b) {
    const size_t before = draft.molecule.springs.size();
    addSpring(draft, a, b);
    if (draft.molecule.springs.size() == before) return;
    Spring& spring = draft.molecule.springs.back();
    spring = like;
    spring.a = a, spring.b = b;
}

// Splits edges in the middle, each once.
class Splitter {
  public:
    explicit Splitter(Draft& draft) : draft_(draft) {}

    static std::pair<int, int> key(int a, int b) { return std::minmax(a, b); }
    void split(int a, int b) {
        if (middles_.contains(key(a, b))) return;
        const Vertex &first = draft_.molecule.vertices[size_t(a)],
                     &other = draft_.molecule.vertices[size_t(b)];
        Vertex middle;
        middle.position = 0.5 * (first.position + other.position);
        middle.uv = 0.5 * (first.uv + other.uv);
        middle.mass = 0.5 * (first.mass + other.mass);
        middle.pinned = first.pinned && other.pinned;
        const int m = middles_[key(a, b)] = add(draft_, middle);
        const int spring = springBetween(draft_.molecule, a, b);
        if (spring < 0) {
            addSpring(draft_, a, m);
            addSpring(draft_, m, b);
            return;
        }
        // one behind the other, two halves are as stiff as the whole
        Spring half = draft_.molecule.springs[size_t(spring)];
        half.stiffness *= 2, half.damping *= 2;
        if (half.restLength) *half.restLength /= 2;
        removeSprings(draft_, {spring});
        add(draft_, half, a, m);
        add(draft_, half, m, b);
    }
    // The middle of an edge; -1: it is whole.
    int middle(int a, int b) const {
        const auto found = middles_.find(key(a, b));
        return found == middles_.end() ? -1 : found->second;
    }

  private:
    Draft& draft_;
    std::map<std::pair<int, int>, int> middles_;
};

// The triangles that take the place of one whose edges may be split, from the corner whose edges differ from
// the others', so that they join the middles.
std::vector<Triangle> partsOf(const Splitter& splitter, Triangle t) {
    std::array<int, 3> m;
    const auto look = [&] {
        m = {splitter.middle(t.a, t.b), splitter.middle(t.b, t.c), splitter.middle(t.c, t.a)};
        return int(m[0] >= 0) + int(m[1] >= 0) + int(m[2] >= 0);
    };
    const int split = look();
    const auto turn = [&] {
        t = {t.b, t.c, t.a};
        look();
    };
    if (split == 0) return {t};
    if (split == 3) return {{t.a, m[0], m[2]}, {m[0], t.b, m[1]}, {m[2], m[1], t.c}, {m[0], m[1], m[2]}};
    if (split == 1) {
        while (m[0] < 0)
            turn();
        return {{t.a, m[0], t.c}, {m[0], t.b, t.c}};
    }
    while (m[2] >= 0)
        turn();
    return {{m[0], t.b, m[1]}, {t.a, m[0], m[1]}, {t.a, m[1], t.c}};
}

}  // namespace

std::string mirrorSide(Draft& draft, int axis) {
    if (axis < 0) return "choose the axis of symmetry first";
    const double flat = nearPlane(draft.molecule);
    std::set<int> gone;
    bool any = false;
    for (size_t v = 0; v < draft.molecule.vertices.size(); ++v) {
        double& place = draft.molecule.vertices[v].position[axis];
        if (place > flat) gone.insert(int(v));
        any = any || place < -flat;
        if (std::abs(place) <= flat) place = 0;
    }
    if (!any) return concat("nothing lies where ", "xyz"[axis], " is below 0, to be mirrored");
    // springs across the plane, by their end on this side and the image of the other
    const std::vector<int> image = mirrored(draft.molecule, axis);
    std::vector<Spring> across;
    for (Spring spring : draft.molecule.springs) {
        if (gone.contains(spring.a) == gone.contains(spring.b)) continue;
        if (gone.contains(spring.a)) std::swap(spring.a, spring.b);
        spring.b = image[size_t(spring.b)];
        if (spring.b >= 0 && !gone.contains(spring.b)) across.push_back(spring);
    }
    std::vector<int> kept(draft.molecule.vertices.size(), -1);
    for (size_t v = 0, next = 0; v < kept.size(); ++v)
        if (!gone.contains(int(v))) kept[v] = int(next++);
    removeVertices(draft, gone);
    const std::vector<Spring> springs = draft.molecule.springs;
    const std::vector<Triangle> triangles = draft.molecule.triangles;
    std::vector<int> other;
    for (size_t v = 0, count = draft.molecule.vertices.size(); v < count; ++v) {
        Vertex vertex = draft.molecule.vertices[v];
        vertex.position[axis] = -vertex.position[axis];
        other.push_back(vertex.position[axis] == 0 ? int(v) : add(draft, vertex));
    }
    const auto on = [&](int v) { return other[size_t(v)]; };
    for (const Spring& spring : springs)
        add(draft, spring, on(spring.a), on(spring.b));
    for (const Triangle& t : triangles)
        if (on(t.a) != t.a || on(t.b) != t.b || on(t.c) != t.c) addTriangle(draft, on(t.a), on(t.c), on(t.b));
    for (const Spring& spring : across) {
        const int a = kept[size_t(spring.a)], b = kept[size_t(spring.b)];
        add(draft, spring, a, on(b));
        add(draft, spring, on(a), b);
    }
    return {};
}

std::string subdivide(Draft& draft, const std::set<int>& triangles) {
    if (draft.molecule.triangles.empty()) return "there are no triangles to be subdivided";
    const double mass = draft.molecule.mass();
    Splitter splitter(draft);
    const std::vector<Triangle> before = draft.molecule.triangles;
    for (size_t i = 0; i < before.size(); ++i) {
        if (!triangles.empty() && !triangles.contains(int(i))) continue;
        const Triangle& t = before[i];
        splitter.split(t.a, t.b);
        splitter.split(t.b, t.c);
        splitter.split(t.c, t.a);
    }
    // those beside them are cut as well, so that no gap opens along a split edge
    std::set<int> replaced;
    for (size_t i = 0; i < before.size(); ++i) {
        const std::vector<Triangle> parts = partsOf(splitter, before[i]);
        if (parts.size() == 1) continue;
        replaced.insert(int(i));
        for (const Triangle& part : parts) {
            addTriangle(draft, part.a, part.b, part.c);
            addSpring(draft, part.a, part.b);
            addSpring(draft, part.b, part.c);
            addSpring(draft, part.c, part.a);
        }
    }
    removeTriangles(draft, replaced);
    const double factor = mass / draft.molecule.mass();
    for (Vertex& vertex : draft.molecule.vertices)
        vertex.mass *= factor;
    return {};
}

std::string weigh(Draft& draft, double density) {
    std::vector<double> masses(draft.molecule.vertices.size(), 0);
    for (const Triangle& t : draft.molecule.triangles)
        for (const int v : {t.a, t.b, t.c})
            masses[size_t(v)] += density * areaOf(draft.molecule, t) / 3;
    bool any = false;
    for (size_t v = 0; v < masses.size(); ++v) {
        if (!(masses[v] > 0)) continue;  // around it there is no area
        draft.molecule.vertices[v].mass = masses[v];
        any = true;
    }
    return any ? "" : "there are no triangles, and so no area, to be weighed";
}

double densityOf(const Molecule& molecule) {
    double area = 0;
    for (const Triangle& t : molecule.triangles)
        area += areaOf(molecule, t);
    return area > 0 ? molecule.mass() / area : 0;
}

}  // namespace shoal
