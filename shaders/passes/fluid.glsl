// The velocity of the fluid around a vertex: the fields, and the winds among the forces.
#include "generated/scene_forces.glsl"
#ifdef FIELDS
#include "generated/fields.glsl"
#endif

uniform float wind;  // factor on the fields

// m/s; time: s since the frame's start.
vec3 fluidAt(vec3 anchor, vec3 position, float time)
{
#ifdef FIELDS
    return withWind(wind * fluidVelocity(anchor, position, time));
#else
    return withWind(vec3(0.0));
#endif
}
