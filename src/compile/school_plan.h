// Schools as a scene asks for them: which groups steer, the grids in which they find one another, and the
// text that makes a body of a molecule. Pure; method and equations: docs/school.md.
//
// A grid holds all molecules of one group, for those of one group that look for them within one radius: every
// school has one of its own, and one of each group that it flees or hunts. The entries of all grids are
// sorted at once: those of a grid have keys of their own, and so a range of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/kernel.h"
#include "scene/scene.h"

namespace shoal {

struct GroupPlan;

// Number of 4-vectors of a molecule: what is known of it (shaders/school/body.glsl), and what steers it
// (shaders/fused/steering.glsl).
constexpr int bodyElements = 4, steeringElements = 3;

struct SchoolGrid {
    size_t group = 0;  // whose molecules
    int entries = 0, firstEntry = 0;
    int keys = 0, firstKey = 0;  // a power of 2 of them
};

struct SchoolMember {
    size_t group = 0;                 // in the plan
    School school;                    // as in the scene
    size_t grid = 0;                  // of its own
    std::vector<size_t> targetGrids;  // of those that it flees, then of those that it hunts
    double length = 0;                // m, of the molecule along z; 0: a point
    bool keel = false;                // its drag has no direction, and does not hold it to its course
};

// A group of which others, or itself, know where its molecules are.
struct SchoolBodies {
    size_t group = 0;
    int first = 0;     // of all bodies
    std::string text;  // generated/body.glsl
};

struct SchoolPlan {
    std::vector<SchoolMember> members;
    std::vector<SchoolBodies> bodies;
    std::vector<SchoolGrid> grids;
    int bodyCount = 0, entries = 0, keys = 0;
    glm::dvec3 origin{0};  // m, near which they are: places count from here

    bool any() const { return !members.empty(); }
    const SchoolBodies& bodiesOf(size_t group) const;
    const SchoolMember* memberOf(size_t group) const;  // null: it does not steer
};

// Error (located at the school): more molecules than can be counted.
SchoolPlan planSchools(const Scene& scene, const std::vector<GroupPlan>& groups);

// Returns how a muscle follows the body's bend: its rest length changes by the share of this (m) times the
// curvature (1/m, about +Y, to the left where positive). 0 of springs that are no muscles.
double bendOf(const Molecule& molecule, const Spring& spring);

}  // namespace shoal
