#include "compile/muscle_waves.h"

#include <cmath>
#include <numbers>

#include "compile/glsl_text.h"
#include "compile/school_plan.h"
#include "core/error.h"

namespace shoal {

namespace {

constexpr double same = 1e-4;  // rad: files round

bool moves(const Spring& spring) {
    return spring.actuation && spring.actuation->amplitude != 0;
}

// Half turns of the phase. One on, it is the same wave upside down.
double halves(const Actuation& muscle) {
    return std::floor((muscle.phase + same) / std::numbers::pi);
}

double phaseOf(const Actuation& muscle) {
    return muscle.phase - halves(muscle) * std::numbers::pi;
}

double signOf(const Actuation& muscle) {
    return std::fmod(std::abs(halves(muscle)), 2.0) == 0 ? 1 : -1;
}

}  // namespace

MuscleWaves::MuscleWaves(const Molecule& molecule, const Needs& needs)
    : molecule_(&molecule), phased_(needs.phase) {
    for (const Spring& spring : molecule.springs)
        if (needs.steers && !needs.liveSprings && moves(spring) && waveOf(*spring.actuation) == waves_.size())
            waves_.push_back({1, spring.actuation->frequency, phaseOf(*spring.actuation)});
}

// The number of them where it is none of them.
size_t MuscleWaves::waveOf(const Actuation& muscle) const {
    for (size_t i = 0; i < waves_.size(); ++i)
        if (waves_[i].frequency == muscle.frequency && std::abs(waves_[i].phase - phaseOf(muscle)) < same)
            return i;
    return waves_.size();
}

std::string MuscleWaves::text() const {
    if (waves_.empty()) return {};
    std::string out = "    float clock = swimClock(time);\n";
    for (size_t i = 0; i < waves_.size(); ++i)
        out += concat("    float wave", i, " = ", waveText(i));
    return out;
}

std::string MuscleWaves::arrayText() const {
    if (waves_.empty()) return {};
    std::string out = concat("#include \"physics/spring.glsl\"\n\n#define WAVES ", waves_.size(),
                             "\nfloat waves[WAVES];\n\n",
                             "void moveMuscles(float time)\n{\n    float clock = swimClock(time);\n");
    for (size_t i = 0; i < waves_.size(); ++i)
        out += concat("    waves[", i, "] = ", waveText(i));
    return out + "}\n";
}

// Writes a wave's pull at the time `clock`.
std::string MuscleWaves::waveText(size_t wave) const {
    return concat("musclePull(vec3(1.0, ", glslLiteral(2 * std::numbers::pi * waves_[wave].frequency), ", ",
                  glslLiteral(waves_[wave].phase), "), 0.0, clock, ", phased_ ? "phase);\n" : "0.0);\n");
}

std::optional<MuscleWaves::Share> MuscleWaves::shareOf(const Spring& spring) const {
    if (waves_.empty()) return {};
    if (!moves(spring)) return Share{};
    return Share{spring.actuation->amplitude * signOf(*spring.actuation), waveOf(*spring.actuation)};
}

std::string MuscleWaves::lengthOf(const std::string& length, const Spring& spring) const {
    const double bend = bendOf(*molecule_, spring);
    if (!moves(spring) && bend == 0) return length;
    const std::optional<Share> share = shareOf(spring);
    const std::string pull =
        moves(spring) ? concat(glslLiteral(share->amplitude), " * wave", share->wave) : "0.0";
    return concat("bentLength(", length, ", ", pull, ", ", glslLiteral(bend), " * curvature)");
}

}  // namespace shoal
