// collide: vertices that entered a collider bounce, slide or rest on its surface.
// Leapfrog's velocity here still lacks the springs' second half kick.
#include "state/textures.glsl"
#include "passes/load.glsl"
#include "generated/colliders.glsl"
#include "step/cut_short.glsl"

uniform vec3 gravity;  // m/s^2
#include "step/fall.glsl"

#if defined(STAGES) && defined(SPRINGS)
uniform sampler2D sumAccelerations;  // m/s^2, of the stages
#endif
uniform vec3 drift;  // physics/collide.glsl: step, kickDrift, lag
uniform float contactTime;  // s, of the substep's end since the frame's start; 0 where no collider moves

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 x = texelFetch(positions, texel, 0).xyz;
    vec3 v = texelFetch(velocities, texel, 0).xyz;
    if (!isPadding(own.y) && !isHeld(inertia(own.x), own.y)) {
        vec3 anchor = texelFetch(records, recordTexel(own.y), 0).xyz;
        takeRadius(texelFetch(constants, recordTexel(own.y), 0).y, 0.0);
        vec3 fall = fallAt(anchor, x);
        vec3 acceleration = fall + loadOn(own);
        vec3 kick = vec3(0.0);
#if defined(STAGES) && defined(SPRINGS)
        acceleration = texelFetch(sumAccelerations, texel, 0).xyz;
#elif defined(ACCELERATION)
        vec3 sprung = texelFetch(accelerations, texel, 0).xyz;
#ifdef LEAPFROG
        kick = sprung * (0.5 * drift.x);
#endif
        acceleration += sprung;
#endif
        vec3 whole = v + kick;
        Drift drifted = Drift(drift.x, drift.y, drift.z, acceleration);
        Contact contact = Contact(x, whole);
        if (margin(anchor, x, v, drift.x, contactTime) < 0.0)
            contact = collideAll(anchor, x, whole, v, fall, drifted, contactTime);
        x = contact.position;
        v = withoutKick(contact.velocity, v, kick);
        if (areTabled && turns > mostTurns) x = cutShort();
    }
    newPosition = vec4(x, 0.0);
    newVelocity = vec4(v, 0.0);
}
