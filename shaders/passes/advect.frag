// advect: moves every vertex by its velocity, under gravity and drag towards the fields' velocity.
//   euler      v += exact drag and gravity at x;  x += h v              (after restore added the springs' kick)
//   verlet     the same, then v = (x' - x) / h
//   leapfrog   v += a h/2;  x += v h/2;  v += exact drag and gravity at that x;  x += v h/2
// The scene's forces join gravity, a wind among them the fields.
// The first advect of a frame also moves positions to the anchor that the records pass has just set.
#include "passes/step.glsl"

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    if (isPadding(own.y)) {
        newPosition = vec4(0.0);
        newVelocity = vec4(0.0);
        return;
    }
    vec3 x = texelFetch(positions, texel, 0).xyz - anchorMove(positions, own.y);
    vec3 v = texelFetch(velocities, texel, 0).xyz;
    if (isHeld(inertia(own.x), own.y)) {
        newPosition = vec4(x, 0.0);
        newVelocity = vec4(0.0);
        return;
    }
    vec3 anchor = texelFetch(records, recordTexel(own.y), 0).xyz;
    vec3 n = texelFetch(vertexNormals, texel, 0).xyz;
#ifdef LEAPFROG
    float halfStep = 0.5 * substep;
#ifdef SPRINGS
    v += texelFetch(accelerations, texel, 0).xyz * halfStep;
#endif
    vec3 probe = x + v * halfStep;
    vec3 before = v;
    v = dragged(v, fieldAt(anchor, probe, time + halfStep), fallAt(anchor, probe), n);
    x += ((slips == 1 ? v : before) + v) * halfStep;  // added at once: one rounding, so that contact can take a drift back exactly
#else
    v = dragged(v, fieldAt(anchor, x, time), fallAt(anchor, x), n);
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
