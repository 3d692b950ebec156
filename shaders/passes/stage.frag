// stage: one of the evaluations of a Runge-Kutta step. positions and velocities are the stage's; its rates
// are added up, and move the start of the substep to the next stage, or after the last one to its end.
#include "passes/springs.glsl"
#include "passes/step.glsl"
#include "passes/load.glsl"
#include "generated/colliders.glsl"
#include "generated/stages.glsl"

uniform sampler2D startPositions;
uniform sampler2D startVelocities;
uniform sampler2D sumVelocities;     // of shareOf(stage) v
uniform sampler2D sumAccelerations;  // of shareOf(stage) a
uniform int stage;                   // from 0

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;
layout(location = 2) out vec4 newSumVelocity;
layout(location = 3) out vec4 newSumAcceleration;

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    newPosition = vec4(0.0);
    newVelocity = vec4(0.0);
    newSumVelocity = vec4(0.0);
    newSumAcceleration = vec4(0.0);
    if (isPadding(own.y)) return;
    vec3 start = texelFetch(startPositions, texel, 0).xyz;
    vec3 shift = anchorMove(startPositions, own.y);
    start -= shift;
    vec4 vertexInertia = inertia(own.x);
    if (isHeld(vertexInertia, own.y)) {
        newPosition = vec4(start, 0.0);
        return;
    }
    vec3 x = texelFetch(positions, texel, 0).xyz;
    if (stage == 0) x -= shift;
    vec3 v = texelFetch(velocities, texel, 0).xyz;
    vec3 anchor = texelFetch(records, recordTexel(own.y), 0).xyz;
    float moment = time + stageTime(stage);
    vec3 fall = fallAt(anchor, x) + loadOn(own);
    vec3 a = dragAcceleration(v, fieldAt(anchor, x, moment), fall, texelFetch(vertexNormals, texel, 0).xyz);
#ifdef SPRINGS
    a += springForces(own.x, own.y, moment) * vertexInertia.x;
#endif
    vec3 startVelocity = texelFetch(startVelocities, texel, 0).xyz;
#ifdef COLLIDE
    // what begins the substep at rest on a collider is held by it, as in solver/runge-kutta.glsl
    if (startVelocity == vec3(0.0)) {
        takeRadius(texelFetch(constants, recordTexel(own.y), 0).y, 0.0);
        vec4 standsOn = footing(anchor, start, time);
        a = heldBy(standsOn.xyz, standsOn.w, a);
    }
#endif
    vec3 sumV = v * shareOf(stage);
    vec3 sumA = a * shareOf(stage);
    if (stage > 0) {
        sumV += texelFetch(sumVelocities, texel, 0).xyz;
        sumA += texelFetch(sumAccelerations, texel, 0).xyz;
    }
    newPosition = vec4(afterStage(stage, start, v, sumV), 0.0);
    newVelocity = vec4(afterStage(stage, startVelocity, a, sumA), 0.0);
    newSumVelocity = vec4(sumV, 0.0);
    newSumAcceleration = vec4(sumA, 0.0);
}
