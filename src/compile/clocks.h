// Computes the parameters of a plan that depend on time: phases, kept in double and handed to the shaders at
// the start of every frame, where they count on in seconds of the frame alone. A float of 1e5 s is a multiple
// of 1/128 s.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/field.h"

namespace shoal {

struct Molecule;
struct Spring;

// One 4-vector of a field's parameters, renewed at the start of a frame at time t:
//   angle    x: start + rate t, rad, less whole turns
//   cells    rate t in cells of a lattice:  x: less whole ones;  y, z: the lower and the upper 16 bits of
//   those frames   x: the frame of a sequence that was last passed;  y: s since then
struct FieldClock {
    enum class Kind { angle, cells, frames };
    Kind kind = Kind::angle;
    size_t slot = 0;
    double rate = 0;              // rad/s, or cells per s
    double start = 0;             // rad
    std::vector<double> times{};  // s, of frames
    double period = 0;            // s, of frames that repeat; 0: they do not
};
void setClocks(std::vector<glm::vec4>& parameters, const std::vector<FieldClock>& clocks, double time);

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
