// The arrays of a plan: the start state and the table of the topology.
#pragma once

#include "compile/plan.h"

namespace shoal {

// The point of the anchors' lattice, of 1/16 m, nearest to a position, m (shaders/physics/anchor.glsl).
template <typename Number>
glm::vec<3, Number> latticePoint(const glm::vec<3, Number>& position) {
    return glm::floor(position * Number(16) + Number(0.5)) * Number(0.0625);
}

// A point of the scene in two parts of which each is a float: a point of the lattice, whose difference to an
// anchor is exact, and the rest. Where one float holds the point to a micrometre it is all rest.
struct SplitPoint {
    glm::dvec3 lattice{0}, rest{0};  // m
    bool isFar() const { return lattice != glm::dvec3(0); }
};
SplitPoint splitPoint(const glm::dvec3& point);
// Whether a place of the force has both parts: because some of its path would lose by one float, or because
// the mouse may hold it anywhere.
bool isFar(const Force& force);

// The length of life of what has this seed, s (shaders/births/emit.glsl).
constexpr uint32_t bornLife = 0xe0000006u, bornTime = 0xe000000fu;
double lifeOf(const glm::dvec2& life, uint32_t seed);

// Returns the steering of molecules that have not steered yet (shaders/fused/steering.glsl).
std::vector<glm::vec4> unsteered(size_t molecules);

// Fills the group's start state and constants: every molecule where it is placed.
void packStart(const Scene& scene, GroupPlan& group);
// Appends the molecule's tables and returns their base index.
int packTopology(const Molecule& molecule, const GroupPlan& group, std::vector<glm::vec4>& topology);
// Replaces the table of a group, whose springs have other numbers but join the same vertices.
void repackTopology(const Molecule& molecule, size_t group, Plan& plan);

}  // namespace shoal
