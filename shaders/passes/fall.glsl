// Gravity and the scene's forces on a vertex.
#include "generated/scene_forces.glsl"

uniform vec3 gravity;  // m/s^2

// m/s^2
vec3 fallAt(vec3 anchor, vec3 position)
{
#ifdef FORCES
    return gravity + forceAcceleration(anchor, position);
#else
    return gravity;
#endif
}
