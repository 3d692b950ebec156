// Drag on a vertex towards the fluid around it. Below, u is the fields' velocity (m/s), a the acceleration of gravity and
// forces (m/s^2) and n the normal of the surface, where drag has a direction.
// Needs generated/fields.glsl, where there are FIELDS, `gravity`, `wind`, the factor on the fields, and `decay`, `phi` and `dragRate` of shaders/fused/state.glsl.
#include "physics/drag.glsl"
#include "step/fall.glsl"

// Whether drag differs across and along the surface.
#ifdef DIRECTIONAL_DRAG
const bool isDirectional = true;
#else
const bool isDirectional = false;
#endif

// Returns the fields' velocity at a position (m, from the anchor) and a time (s since the frame's start), in m/s.
#ifdef FIELDS
const bool hasFields = true;

vec3 fieldAt(vec3 anchor, vec3 position, float time)
{
    return wind * fluidVelocity(anchor, position, time);
}
#else
const bool hasFields = false;

vec3 fieldAt(vec3 anchor, vec3 position, float time)
{
    return vec3(0.0);
}
#endif

// Returns the fluid's velocity in m/s: u, if there are fields, and the wind among the forces.
vec3 fluidOf(vec3 u)
{
    return withWind(hasFields ? u : vec3(0.0));
}

// Returns the velocity (m/s) after drag and the acceleration have acted, by factors across and along the surface.
vec3 draggedBy(vec3 velocity, vec3 u, vec3 a, vec3 n, vec2 decays, vec2 phis)
{
    u = fluidOf(u);
    if (isDirectional) return directionalDragAndGravity(velocity, u, a, n, decays, phis);
    return dragAndGravity(velocity, u, a, decays.y, phis.y);
}

// Returns the velocity (m/s) a substep later, exactly.
vec3 dragged(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    return draggedBy(velocity, u, a, n, decay, phi);
}

// Returns the acceleration now, m/s^2.
vec3 dragAcceleration(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    vec3 slip = fluidOf(u) - velocity;
    a += slip * dragRate.y;
    if (isDirectional) a += n * (dot(slip, n) * (dragRate.x - dragRate.y));
    return a;
}
