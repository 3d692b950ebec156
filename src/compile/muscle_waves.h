// The muscles of molecules that steer, as GLSL: they run by the molecule's own clock
// (shaders/fused/steering.glsl), and bend it. Those that move together, or against one another, share a wave,
// so that a body whose springs are muscles takes a few sines.
#pragma once

#include <string>
#include <vector>

#include "compile/kernel.h"
#include "molecule/molecule.h"

namespace shoal {

class MuscleWaves {
  public:
    // Borrows the molecule. Without needs.steers there is nothing.
    MuscleWaves(const Molecule& molecule, const Needs& needs);
    // Statements at the head of a function of `time`; may be empty.
    std::string text() const;
    // Returns the rest length that the muscles give to a spring of rest length `length`; both are GLSL.
    std::string lengthOf(const std::string& length, const Spring& spring) const;

  private:
    size_t waveOf(const Actuation& muscle) const;

    const Molecule* molecule_;
    bool phased_;
    std::vector<Actuation> waves_;  // amplitude 1, phase in [0, pi)
};

}  // namespace shoal
