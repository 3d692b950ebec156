// Contact of molecules with one another, as a scene asks for it: which spheres there are, the grid that finds
// those that touch, and how a frame is cut into contact steps. Pure; method and equations: docs/contact.md.
//
// A molecule of a group with contact carries a sphere at every vertex, then, where asked, one at the middle
// of every triangle, which moves and is pushed as the mean of its corners. Spheres are numbered through all
// groups with contact:
//
//   sphere k of molecule m of group g:   g.firstSphere + m * g.spheresOf + k
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/tower.h"
#include "molecule/gap.h"
#include "scene/scene.h"

namespace shoal {

struct GroupPlan;

struct ContactGroup {
    size_t group = 0;     // in the plan
    int firstSphere = 0;  // of all
    int spheresOf = 0;    // of a molecule
    double radius = 0;    // m, at scale 1
    // Factors on it at birth and at the end of life: as a particle is drawn.
    glm::dvec2 growth{1};
    // kg, the least and the most of what an impulse on a sphere moves: a vertex, or a whole body. Nothing of
    // it that is pinned counts; where all is, both are 0.
    glm::dvec2 masses{0};
    bool soft = false;  // vertices move against one another: more than one, and no rigid body
    bool triangles = false, self = false;
    std::vector<TrianglePoint> points;  // of the spheres behind those of the vertices
    std::vector<glm::vec4> shapes;      // shaders/contact/grid/shape.glsl
    // With `self`: bit k of the words of a sphere tells that it does not meet sphere k of its own molecule:
    // itself, and what is closer than two radii in the rest shape. `wordsOf` words a sphere.
    std::vector<uint32_t> apart;
    int wordsOf = 0;

    // CONTACT_RADIUS and, of what grows, CONTACT_GROWTH, for shaders/step/surfaces.glsl.
    std::vector<std::string> defines() const;
};

struct ContactPlan {
    // Spheres are in contact below so many times the sum of their radii: what rests on another and opens by a
    // hair is not forgotten.
    static constexpr double near = 1.02;
    // s: a molecule rests that has stayed where it was for so long.
    static constexpr double restTime = 0.25;
    // So many of the colliders near a sphere are known to its response.
    static constexpr int mostColliders = 3;
    std::vector<ContactGroup> groups;
    int spheres = 0;
    double largestRadius = 0;  // m, with the largest scale
    // m: spheres whose centres are further apart neither touch nor have passed through each other in the last
    // contact step.
    double reach = 0;
    // m, of the grid; at least twice `reach` and finestCell, of 5 significant bits
    // (shaders/physics/cells.glsl).
    static constexpr double finestCell = 1e-6;
    double cell = 0;
    int tableBits = 0;    // cells are hashed into a table of 2^tableBits
    int listLength = 24;  // spheres that one may touch, where there is room for them
    int steps = 1;        // of a frame
    ContactSettings settings;
    Tower tower;
    bool unlikeMasses = false;  // of what contact moves: more than ten times apart
    // x restitution, y friction of groups a and b, at a * groups.size() + b.
    std::vector<glm::vec2> pairs;

    bool any() const { return !groups.empty(); }
    // Returns the contact of a group of the plan, or null.
    const ContactGroup* find(size_t group) const {
        const auto found = std::find_if(groups.begin(), groups.end(),
                                        [&](const ContactGroup& each) { return each.group == group; });
        return found == groups.end() ? nullptr : &*found;
    }
    // Whether contacts are remembered from step to step.
    bool remembers() const { return settings.response == ContactResponse::simultaneous; }
    // Whether molecules of a group may rest: its springs do not move by themselves.
    bool mayRest(const GroupPlan& group) const;
    size_t cells() const { return size_t(1) << tableBits; }  // of that table
    // So many times its own mass a sphere carries at rest, with so many iterations; under more it sways, or
    // what lies on it sinks in. Measured: docs/contact-figures.md.
    static double carried(int iterations);
    // So many let a tower of twenty rest whose marbles are light and heavy in turn, one `massRatio` times the
    // other, and heaps of such; and a tower of solids of so many levels.
    static int iterationsFor(double massRatio, int levels);
    // The lightest and the heaviest of what contact moves, and how many times as heavy it is; null where all
    // is held.
    struct Masses {
        const ContactGroup *lightest = nullptr, *heaviest = nullptr;
        double ratio = 1;
    };
    Masses masses() const;
    // Rounds of impacts in a step.
    static constexpr int mostRounds = 4;
    // How far an iteration of so many goes on beyond the last, as a part of what that changed. What a step
    // has to find is mostly smooth, which momentum finds soonest; but few iterations overshoot with much of
    // it. Unlike masses take what is smoother still, which momentum that grows as Nesterov's k / (k + 3)
    // finds soonest; else it leaves more after many iterations.
    static float momentum(int iteration, int iterations, bool unlikeMasses);
    // m/s: spheres that move faster relative to one another may pass through each other between two contact
    // steps.
    double safeSpeed(double frameTime) const;
};

// Where spheres of contact lie on triangles.
std::vector<TrianglePoint> trianglePoints(const Molecule& molecule, const GroupContact& contact);

// The largest gap that the spheres of contact leave open.
Gap largestGap(const Molecule& molecule, const GroupContact& contact);

// Error (located at the group's contact): more spheres than 2^27, or than a label names; a radius that the
// cell given does not hold; masses that differ by more than a factor of 1e6.
ContactPlan planContact(const Scene& scene, const std::vector<GroupPlan>& groups);

}  // namespace shoal
