// Which vertices of a molecule that is made from a mesh are pinned: by where they lie, by the name of what
// they belong to, or by the colour that they are painted with.
#pragma once

#include <string>
#include <vector>

#include "author/coarse.h"

namespace shoal {

// "y<0.1": the coordinate in shares of the mesh's box, from 0 to 1. "y<0.02m": in metres.
struct PinRule {
    int axis = 1;
    bool below = true;
    double limit = 0;
    bool metres = false;
    std::string text;
};

// Error: not such a rule.
PinRule parsePinRule(const std::string& text);
// Linear RGB: red, green, blue, yellow, cyan, magenta, white, black, or three numbers from 0 to 1
// ("1,0.5,0"). Error: neither.
glm::dvec3 parsePaint(const std::string& text);

struct PinChoice {
    std::vector<PinRule> rules;
    std::vector<std::string> names;   // of objects, meshes or materials
    std::vector<std::string> paints;  // vertex colours
    bool any() const { return !rules.empty() || !names.empty() || !paints.empty(); }
};

// For each coarse vertex: it is pinned when most of the source's vertices that it stands for are; when that
// leaves none, the one with the largest share. A rule that no vertex meets, a name that is not there or a
// colour that is not painted: Error.
std::vector<bool> choosePins(const Mesh& mesh, const CoarseMesh& coarse, const PinChoice& choice);

}  // namespace shoal
