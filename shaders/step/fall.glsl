// Gravity and the scene's forces on a vertex. Needs `gravity`, m/s^2.
#include "generated/scene_forces.glsl"

// Returns their acceleration at a position (m, from the anchor), in m/s^2, without steering.
vec3 fallAt(vec3 anchor, vec3 position)
{
#ifdef FORCES
    return gravity + forceAcceleration(anchor, position);
#else
    return gravity;
#endif
}
