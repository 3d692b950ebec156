#include "author/edit.h"

#include <algorithm>
#include <cmath>

#include "author/springs.h"

namespace shoal {

namespace {

std::vector<int> imagesIn(const Molecule& molecule, int axis) {
    return axis < 0 ? std::vector<int>(molecule.vertices.size(), -1) : mirrored(molecule, axis);
}

int triangleBetween(const Molecule& molecule, const std::set<int>& corners) {
    for (size_t i = 0; i < molecule.triangles.size(); ++i) {
        const Triangle& t = molecule.triangles[i];
        if (std::set<int>{t.a, t.b, t.c} == corners) return int(i);
    }
    return -1;
}

}  // namespace

double nearPlane(const Molecule& molecule) {
    return 5e-4 * molecule.size();
}

ElementSet withMirror(const Molecule& molecule, const ElementSet& selected, int axis) {
    ElementSet out = selected;
    if (axis < 0) return out;
    const std::vector<int> image = imagesIn(molecule, axis);
    for (const int v : selected.vertices)
        if (image[size_t(v)] >= 0) out.vertices.insert(image[size_t(v)]);
    for (const int s : selected.springs) {
        const Spring& spring = molecule.springs[size_t(s)];
        const int found = springBetween(molecule, image[size_t(spring.a)], image[size_t(spring.b)]);
        if (found >= 0) out.springs.insert(found);
    }
    for (const int i : selected.triangles) {
        const Triangle& t = molecule.triangles[size_t(i)];
        const int found =
            triangleBetween(molecule, {image[size_t(t.a)], image[size_t(t.b)], image[size_t(t.c)]});
        if (found >= 0) out.triangles.insert(found);
    }
    return out;
}

void moveVertices(Draft& draft, const Draft& before, const std::set<int>& vertices, const glm::dvec3& shift,
                  int axis) {
    const std::vector<int> image = imagesIn(before.molecule, axis);
    for (const int v : vertices) {
        const glm::dvec3& from = before.molecule.vertices[size_t(v)].position;
        glm::dvec3 to = from + shift;
        const int other = image[size_t(v)];
        if (other == v) to[axis] = from[axis];
        draft.molecule.vertices[size_t(v)].position = to;
        if (other < 0 || other == v || vertices.contains(other)) continue;
        to[axis] = -to[axis];
        draft.molecule.vertices[size_t(other)].position = to;
    }
}

int addVertexAt(Draft& draft, const glm::dvec3& position, int axis) {
    glm::dvec3 place = position;
    const bool flat = axis >= 0 && std::abs(place[axis]) <= nearPlane(draft.molecule);
    if (flat) place[axis] = 0;
    const int out = addVertex(draft, place);
    if (axis < 0 || flat) return out;
    place[axis] = -place[axis];
    addVertex(draft, place);
    return out;
}

int connect(Draft& draft, int a, int b, int axis) {
    const std::vector<int> image = imagesIn(draft.molecule, axis);
    const int out = addSpring(draft, a, b);
    if (image[size_t(a)] >= 0 && image[size_t(b)] >= 0) addSpring(draft, image[size_t(a)], image[size_t(b)]);
    return out;
}

int addFace(Draft& draft, int a, int b, int c, int axis) {
    const std::vector<int> image = imagesIn(draft.molecule, axis);
    const int out = addTriangle(draft, a, b, c);
    const int p = image[size_t(a)], q = image[size_t(b)], r = image[size_t(c)];
    // a mirror turns round what it shows
    if (p >= 0 && q >= 0 && r >= 0) addTriangle(draft, p, r, q);
    return out;
}

void removeSelected(Draft& draft, const ElementSet& selected, int axis) {
    const ElementSet all = withMirror(draft.molecule, selected, axis);
    removeTriangles(draft, all.triangles);
    removeSprings(draft, all.springs);
    removeVertices(draft, all.vertices);
}

void flipTriangles(Draft& draft, const std::set<int>& triangles) {
    for (const int i : triangles)
        std::swap(draft.molecule.triangles[size_t(i)].b, draft.molecule.triangles[size_t(i)].c);
}

int braceSoftModes(Draft& draft) {
    const Bracing bracing = brace(draft.molecule, nullptr, true);
    for (const auto& [a, b] : bracing.added)
        addSpring(draft, a, b);
    return int(bracing.added.size());
}

std::set<int> selectedSprings(const Molecule& molecule, const ElementSet& selected) {
    std::set<int> out = selected.springs;
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Spring& spring = molecule.springs[i];
        if (selected.vertices.contains(spring.a) && selected.vertices.contains(spring.b)) out.insert(int(i));
    }
    return out;
}

}  // namespace shoal
