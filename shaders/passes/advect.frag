// advect: moves every vertex by its velocity, under gravity and drag towards the fields' velocity.
//   euler      v += exact drag and gravity at x;  x += h v              (after restore added the springs' kick)
//   verlet     the same, then v = (x' - x) / h
//   leapfrog   v += a h/2;  x += v h/2;  v += exact drag and gravity at that x;  x += v h/2
// The scene's forces join gravity, a wind among them the fields.
// The first advect of a frame also moves positions to the anchor that the records pass has just set.
#include "passes/step.glsl"
#include "passes/load.glsl"

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
    if (isHeld(inertia(own.x), own.y)) {
        newPosition = vec4(x, 0.0);
        newVelocity = vec4(0.0);
        return;
    }
    vec3 anchor = texelFetch(records, recordTexel(own.y), 0).xyz;
    vec3 n = texelFetch(vertexNormals, texel, 0).xyz;
#ifdef LEAPFROG
    float ahead = 0.5 * substep;  // s, to where drag and gravity are taken
#else
    float ahead = 0.0;
#endif
    vec3 v = kickedVelocity(texel, ahead);
    vec3 probe = x + v * ahead;
    vec3 before = x;
    vec3 ended = dragged(v, fieldAt(anchor, probe, time + ahead), fallAt(anchor, probe) + loadOn(own), n);
    x += driftOf(v, ended);
    v = velocityAfter(ended, x - before);
    newPosition = vec4(x, 0.0);
    newVelocity = vec4(v, 0.0);
}
