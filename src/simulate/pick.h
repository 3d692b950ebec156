// The molecule under the pointer, and what it does.
#pragma once

#include <optional>

#include "molecule/molecule.h"
#include "simulate/simulation.h"

namespace shoal {

struct Ray {
    glm::dvec3 from{0}, along{0, 0, -1};  // m; unit
};

struct PickedMolecule {
    size_t group = 0;  // of the plan
    int molecule = 0;
    bool operator==(const PickedMolecule&) const = default;
};

struct RayHit {
    int molecule = 0;
    double distance = 0;  // m, from the ray's start
};
// The first molecule of a group that the ray meets: a triangle, or else a vertex that it passes within
// `radius` m, or within `angle` rad of. Those that are not alive are not met.
std::optional<RayHit> firstHit(const Ray& ray, const Snapshot& state, const Molecule& shape, double radius,
                               double angle);

struct MoleculeNumbers {
    glm::dvec3 middle{0};    // m, of the mass
    glm::dvec3 velocity{0};  // m/s, of the middle
    double scale = 1;
    double kinetic = 0, elastic = 0;  // J
    double strain = 0;                // the largest, (length - rest) / rest; muscles at rest
    int strained = -1;                // the spring that has it; -1: there are none
    bool alive = true;
    std::optional<glm::dvec2> life;  // s: age, and length of life; nothing: it lives for ever
    bool released = false;           // its pins are released
};
// `state`: one molecule, as Simulation::readMolecules has it. `stiffness`: the factor on all springs.
MoleculeNumbers numbersOf(const GroupState& state, const Molecule& shape, double stiffness);

}  // namespace shoal
