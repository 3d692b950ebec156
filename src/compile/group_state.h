// A group's state outside the GPU, exact to the bit and the same for every path: where a run starts, what is
// carried from one path to the other, what tests compare.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "compile/birth_schedule.h"

namespace shoal {

constexpr float noHistory = 1e30f;

// Holds the state that changes. Vertices: index = molecule * vertexCount + vertex. The others: one entry a
// molecule.
struct GroupState {
    std::vector<glm::vec3> positions;   // m, relative to the molecule's anchor
    std::vector<glm::vec3> velocities;  // m/s
    std::vector<glm::vec3> anchors;     // m, on the lattice of 1/16 m
    std::vector<uint8_t> released;      // 1: the pins are released
    // Solvers with history (scene/solver.h) keep the last substep's changes here; empty for the others. A
    // molecule whose first displacement is (noHistory, ...) starts anew.
    std::vector<glm::vec3> displacements;    // m
    std::vector<glm::vec3> velocityChanges;  // m/s
    // Groups with birth or death (compile/life_plan.h) keep these; empty for the others. One entry a place,
    // but for clocks and totals.
    std::vector<glm::vec2> lives;    // x age, y length of life, s; y = 0: free
    std::vector<uint32_t> seeds;     // below 2^24
    std::vector<glm::vec2> looks;    // x scale of the rest lengths, y phase of the muscles, rad
    std::vector<BirthClock> clocks;  // one an emitter
    std::vector<uint64_t> totals;    // born so far, and births that found no place
    // Allocators on the CPU: when each place is free again, s. Stack: its free places, the top last; then
    // as many zeros as there are places that are taken.
    std::vector<double> ends;
    std::vector<uint32_t> freed;
    // Schools keep three a molecule (shaders/fused/steering.glsl); empty for the others.
    std::vector<glm::vec4> steering;

    bool operator==(const GroupState&) const = default;
};

// Holds the state that does not change, one entry a molecule.
struct GroupConstants {
    std::vector<uint32_t> seeds;  // below 2^24, so that a float holds them
    std::vector<float> scales;    // of the rest lengths
    std::vector<float> phases;    // rad, added to every actuation
};

}  // namespace shoal
