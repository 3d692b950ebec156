// Computes the parameters of a plan that depend on time: phases, kept in double and handed to the shaders at
// the start of every frame, where they count on in seconds of the frame alone. A float of 1e5 s is a multiple
// of 1/128 s.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/glsl_call.h"

namespace shoal {

struct Molecule;
struct Spring;

// The clock of one of a plan's parameters.
struct ClockSlot : FieldClock {
    size_t slot = 0;
};
void setClocks(std::vector<glm::vec4>& parameters, const std::vector<ClockSlot>& clocks, double time);

// The different frequencies of a molecule's muscles, Hz, and the place of a spring's among them.
std::vector<double> muscleFrequencies(const Molecule& molecule);
size_t muscleNumber(const std::vector<double>& frequencies, const Spring& spring);
// Frequencies of one molecule: four share a 4-vector of uniforms.
constexpr size_t mostMuscleFrequencies = 128;
// s, at most 256, after which waves of these frequencies are where they were: exactly, or as nearly as any
// such time has it. 0: none moves.
double commonPeriod(const std::vector<double>& frequencies);
// rad, how far each muscle's wave is at a time, four in a 4-vector; at least one of those.
std::vector<glm::vec4> muscleAngles(const std::vector<double>& frequencies, double time);

}  // namespace shoal
