// advect: moves every vertex by its velocity, under gravity and drag towards the fields' velocity.
//   euler      v += exact drag and gravity at x;  x += h v              (after restore added the springs' kick)
//   verlet     the same, then v = (x' - x) / h
//   leapfrog   v += a h/2;  x += v h/2;  v += exact drag and gravity at that x;  x += v h/2
// The scene's forces join gravity, a wind among them the fields.
// The first advect of a frame also moves positions to the anchor that the records pass has just set.
#include "state/textures.glsl"
#include "physics/anchor.glsl"
#include "physics/drag.glsl"
#include "passes/fall.glsl"
#include "passes/fluid.glsl"

uniform sampler2D vertexNormals;
uniform float time;       // s, at the start of the substep, since the frame's
uniform float substep;    // h, s
uniform vec2 decay;       // 1 - exp(-gamma h) across and along the surface
uniform vec2 phi;         // decay / gamma, h where gamma = 0
uniform int slips;        // 1: drag is so heavy that positions drift by the new velocity alone
uniform int moveAnchors;  // 1 in the first substep

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;

vec3 accelerate(vec3 v, vec3 anchor, vec3 x, float t, ivec2 texel)
{
    vec3 u = fluidAt(anchor, x, t);
    vec3 a = fallAt(anchor, x);
#ifdef DIRECTIONAL_DRAG
    return directionalDragAndGravity(v, u, a, texelFetch(vertexNormals, texel, 0).xyz, decay, phi);
#else
    return dragAndGravity(v, u, a, decay.y, phi.y);
#endif
}

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (isPadding(own.y)) {
        newPosition = vec4(0.0);
        newVelocity = vec4(0.0);
        return;
    }
    vec3 x = texelFetch(positions, texel, 0).xyz;
    vec3 v = texelFetch(velocities, texel, 0).xyz;
#ifdef RECORDS
    if (moveAnchors == 1) x -= anchorShift(texelFetch(positions, stateTexel(0, own.y), 0).xyz);
#endif
    if (isHeld(inertia(own.x), own.y)) {
        newPosition = vec4(x, 0.0);
        newVelocity = vec4(0.0);
        return;
    }
    vec3 anchor = texelFetch(records, recordTexel(own.y), 0).xyz;
#ifdef LEAPFROG
    float halfStep = 0.5 * substep;
#ifdef SPRINGS
    v += texelFetch(accelerations, texel, 0).xyz * halfStep;
#endif
    vec3 before = v;
    v = accelerate(v, anchor, x + before * halfStep, time + halfStep, texel);
    x += ((slips == 1 ? v : before) + v) * halfStep;  // added at once: one rounding, so that contact can take a drift back exactly
#else
    v = accelerate(v, anchor, x, time, texel);
#ifdef VERLET
    vec3 before = x;
    x += v * substep;
    v = (x - before) / substep;
#else
    x += v * substep;
#endif
#endif
    newPosition = vec4(x, 0.0);
    newVelocity = vec4(v, 0.0);
}
