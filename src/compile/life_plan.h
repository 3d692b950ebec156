// Birth and death of a group, as the paths take it.
//
// A place is a molecule's slot in the state. It is taken while its length of life is above 0; what is in it
// lives on while its age is below that, and frees it at the end of the frame (or contact step) in which it is
// not. What is freed keeps its last state.
//
// Newborn number n of an emitter draws all that is random from one seed, a hash of the group's, the emitter's
// index and n; of an emitter from deaths, of the seed of what died and of its number among that one's
// newborns.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/emitter.h"

namespace shoal {

struct LifePlan {
    static constexpr size_t noSource = std::numeric_limits<size_t>::max();

    Lifecycle cycle;
    int atStart = 0;              // taken places at the start
    uint32_t seed = 0;            // of all that is born
    std::vector<size_t> sources;  // of each emitter: the plan's group from whose deaths it emits, or noSource
    bool feeds = false;           // some group emits from the deaths of this one
    std::string source;           // generated/emitters.glsl
    std::vector<glm::dvec3> middles;  // m, of the emitters, without their paths

    bool emits() const { return !cycle.emitters.empty(); }
};

}  // namespace shoal
