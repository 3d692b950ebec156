// Edits of a draft, and of its mirror image where symmetry is on. `axis`: the normal of the plane of symmetry
// (0 x, 1 y, 2 z), or -1 for none. Elements that have no mirror image are edited alone.
#pragma once

#include <set>
#include <vector>

#include "molecule/draft.h"

namespace shoal {

struct ElementSet {
    std::set<int> vertices, springs, triangles;
    bool empty() const { return vertices.empty() && springs.empty() && triangles.empty(); }
    bool operator==(const ElementSet&) const = default;
};

// With the images of what is selected.
ElementSet withMirror(const Molecule& molecule, const ElementSet& selected, int axis);

// Moves the vertices by `shift`, and their images by its mirror image; a vertex on the plane stays on it.
// Starts from their positions in `before`, so that one drag does not add up.
void moveVertices(Draft& draft, const Draft& before, const std::set<int>& vertices, const glm::dvec3& shift,
                  int axis);
// The new vertex; its image is there, too, unless it lies on the plane.
int addVertexAt(Draft& draft, const glm::dvec3& position, int axis);
int connect(Draft& draft, int a, int b, int axis);         // the spring; -1: none
int addFace(Draft& draft, int a, int b, int c, int axis);  // the triangle; -1: none
void removeSelected(Draft& draft, const ElementSet& selected, int axis);
void flipTriangles(Draft& draft, const std::set<int>& triangles);

// Adds springs until nothing but motion of the whole is without stiffness (author/springs.h), as stiff as
// most. Says how many; 0: none helps, as in what is flat.
int braceSoftModes(Draft& draft);

// Springs whose two ends are selected, or that are selected themselves.
std::set<int> selectedSprings(const Molecule& molecule, const ElementSet& selected);

}  // namespace shoal
