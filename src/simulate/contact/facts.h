// What shaders of contact are told of a scene: which arrays it needs (shaders/contact/arrays.txt), constants
// and switches that they ask for, and which of several files does something in its way.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "compile/plan.h"

namespace shoal {

// The facts of a scene's contact, on a path.
struct ContactFacts {
    bool textures = false, fused = true;
    bool counted = false;  // the cells are filled by counting instead of sorting
    bool remembers = false, rests = false, staggers = false;
    bool sweeps = false;  // contact is searched along the way within a step
    bool self = false;
    bool spreads = false;  // the contacts of one sphere move others
    bool colliders = false, rigid = false;

    std::set<std::string> names() const;       // of those that hold
    std::vector<std::string> defines() const;  // true or false, and switches
};

// The facts of one group of them.
struct ContactGroupFacts {
    bool rigid = false, triangles = false, pins = false, release = false;
    bool collides = false;          // its spheres look for colliders as they are made
    bool severalColliders = false;  // of the scene, or one that moves or is thin
    bool vertexTextures = false;    // the state has a texel a vertex
    std::vector<std::string> defines() const;
    std::map<std::string, std::string> files() const;
};

ContactFacts contactFacts(const Plan& plan, bool textures, bool fused, bool counts);

}  // namespace shoal
