// The muscles of molecules that steer, as GLSL: they run by the molecule's own clock
// (shaders/fused/steering.glsl), and bend it. Those that move together, or against one another, share a wave,
// so that a body whose springs are muscles takes a few sines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/kernel.h"
#include "molecule/molecule.h"

namespace shoal {

class MuscleWaves {
  public:
    // Borrows the molecule. Without needs.steers, or with needs.liveSprings, there is nothing.
    MuscleWaves(const Molecule& molecule, const Needs& needs);
    // Statements at the head of a function of `time`; may be empty.
    std::string text() const;
    // Returns the rest length that the muscles give to a spring of rest length `length`; both are GLSL.
    std::string lengthOf(const std::string& length, const Spring& spring) const;

    // Returns the same for a lane a vertex (shaders/step/gather_springs.glsl): WAVES, the array of them and
    // what moves them; empty where there are none.
    std::string arrayText() const;
    // A spring's part in a wave; nothing where there are none.
    struct Share {
        double amplitude = 0;
        size_t wave = 0;
    };
    std::optional<Share> shareOf(const Spring& spring) const;

  private:
    std::string waveText(size_t wave) const;
    size_t waveOf(const Actuation& muscle) const;

    const Molecule* molecule_;
    bool phased_;
    std::vector<Actuation> waves_;  // amplitude 1, phase in [0, pi)
};

}  // namespace shoal
