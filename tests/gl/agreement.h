// One frame from one state, run in two ways, and how far apart they end.
#pragma once

#include <optional>
#include <string>

#include "gl/numerics.h"

namespace shoal::test {

// Where a vertex touches something or pins are released, a rounding decides in which substep: such molecules
// may be further apart, and are counted. (On Mesa's rasteriser none is.)
struct Comparison {
    int molecules = 0, contacts = 0, releases = 0;
    int excepted = 0;     // beyond the tolerance, with a contact or a release
    int wrong = 0;        // beyond the tolerance without
    double largest = 0;   // deviation of a position, in molecule sizes, of those that are not excepted
    double velocity = 0;  // likewise of a velocity, times the frame's duration
    double normal = 0;    // likewise of a normal
    double exempted = 0;  // the largest of the excepted
};
std::string text(const Comparison& comparison);

class Agreement {
  public:
    // 1e-5 of a molecule's size: one rounding of a position, up to 1 m from its anchor, is 6e-8 m, and each
    // of a frame's substeps makes a few. Velocities count as far as they carry in a frame.
    static constexpr double tolerance = 1e-5;
    // The tolerance of unit normals; a thin triangle's turns by many times what its corners move.
    static constexpr double normalTolerance = 1e-3;

    Agreement(const Scene& scene, const SimulationOptions& first, const SimulationOptions& second);

    // One frame from the state at the frame given, which the first way reaches.
    Comparison at(int frame);
    Simulation& first() { return first_; }

  private:
    Plan plan_;
    Simulation first_, second_;
    std::optional<Simulation> touching_,
        free_;  // with and without colliders, where there are some; by passes where these have the solver
};

// Whether the context runs the plan on the path.
bool takes(const Plan& plan, Path path);

// Whether the context has the fused path; warns where it does not.
bool canFuse();

}  // namespace shoal::test
