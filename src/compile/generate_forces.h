// The forces that act on a group as straight-line GLSL. Their numbers are uniforms, renewed every frame
// (simulate/step.h), so that neither a path nor the mouse nor a slider compiles anything. What
// does not act on the group is not in its text.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace shoal {

struct GroupForces {
    // generated/scene_forces.glsl, of those functions that are needed.
    //   vec3 forceAcceleration(vec3 anchor, vec3 position)    m/s^2, of the kinds that depend on the place
    //   vec3 thrustedVelocity(vec3 velocity, bool whole)      after a substep or half of one
    //   vec3 thrustedOver(vec3 velocity, float time)          after any time, s
    //   vec3 withWind(vec3 velocity)                          m/s, of the fluid; always
    std::string source;
    struct Entry {
        size_t force = 0;  // its index in the scene
        size_t slot = 0;   // of its first parameter
    };
    std::vector<Entry> pulls, thrusts, winds;
    size_t windSlot = 0;  // of the winds' sum
    size_t parameterCount = 0;

    bool any() const { return parameterCount > 0; }
};

// 4-vectors of uniforms that the forces on a group may take, beside those of fields or colliders in a
// fragment shader (maxParameters).
constexpr size_t maxForceParameters = 32;

// `dragged`: wind moves the group.
GroupForces generateForces(const std::vector<Force>& forces, const std::string& group, bool dragged);

}  // namespace shoal
