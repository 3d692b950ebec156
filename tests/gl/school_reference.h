// How a school steers, in double precision, by looking at all pairs: independent of the shaders that it is
// compared with (shaders/school).
#pragma once

#include <array>
#include <vector>

#include "compile/plan.h"
#include "simulate/simulation.h"

namespace shoal::test {

// The motion of a molecule as a whole, computed from its state.
struct SchoolBody {
    glm::dvec3 place, velocity, forward, upper, spin;
    uint32_t seed = 0;
    bool alive = true;
};

// The three 4-vectors that steer a molecule (shaders/fused/steering.glsl), and the sums behind them.
struct Steered {
    std::array<glm::dvec4, 3> record;
    int others = 0;
};

class SchoolReference {
  public:
    SchoolReference(const Scene& scene, const Plan& plan) : scene_(&scene), plan_(&plan) {}
    // Both answer for each molecule of a group, from a state at the start of a frame.
    std::vector<SchoolBody> bodies(size_t group, const GroupState& state) const;
    std::vector<Steered> steer(size_t group, const SavedState& state, double duration) const;

  private:
    double clearance(const glm::dvec3& place) const;
    glm::dvec3 fromWalls(const School& school, const SchoolBody& body) const;
    glm::dvec3 meetTargets(const School& school, const SavedState& state, const SchoolBody& body) const;

    const Scene* scene_;
    const Plan* plan_;
};

}  // namespace shoal::test
