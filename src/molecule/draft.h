// A molecule that is being edited. It remembers which element of its file each of its own was, so that saving
// changes what changed and nothing else: comments, key order and the spelling of numbers stay.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "molecule/molecule.h"

namespace shoal {

struct Draft {
    Molecule molecule;
    // Holds, for each element, its index in the file, ascending; -1: new.
    struct Origins {
        std::vector<int> vertices, springs, bends, triangles;
        bool operator==(const Origins&) const = default;
    } origins;

    Draft() = default;
    explicit Draft(Molecule read);  // as it stands in its file
};

// These edits may leave a molecule that is not valid, which problemOf() tells.
int addVertex(Draft& draft, const glm::dvec3& position);  // with the mass that most have
// The spring between two vertices, added where there is none, as stiff as most. -1: they are one vertex.
int addSpring(Draft& draft, int a, int b);
// -1: two corners are one, or the triangle is there in any order.
int addTriangle(Draft& draft, int a, int b, int c);
void removeVertices(Draft& draft, const std::set<int>& vertices);  // with all that depends on them
void removeSprings(Draft& draft, const std::set<int>& springs);
void removeBends(Draft& draft, const std::set<int>& bends);
void removeTriangles(Draft& draft, const std::set<int>& triangles);

int springBetween(const Molecule& molecule, int a, int b);  // -1: none

// Returns, for each vertex, the one in its mirror image across the plane through the origin with this axis
// (0 x, 1 y, 2 z) as normal; itself on the plane; -1: none within a thousandth of the size.
std::vector<int> mirrored(const Molecule& molecule, int axis);

// Why the molecule cannot be written or run as it is, in the words of the reader; empty: it can.
std::string problemOf(const Molecule& molecule);

// `text`, from which the draft's molecule was read, with what was changed since.
// Error: the text is of another molecule than the draft came from; the draft is not valid.
std::string withEdits(const std::string& text, const Draft& draft);

}  // namespace shoal
