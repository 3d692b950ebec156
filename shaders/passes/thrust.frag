// thrust: what propels itself gains along its molecule's mean velocity, or loses. Exact, over a substep or half of one.
#include "state/textures.glsl"
#include "generated/scene_forces.glsl"

uniform int whole;  // 1: over a whole substep

layout(location = 0) out vec4 newVelocity;

void main()
{
    ivec2 own = ownAddress();
    vec3 v = texelFetch(velocities, ivec2(gl_FragCoord.xy), 0).xyz;
    if (!isPadding(own.y) && !isHeld(inertia(own.x), own.y)) {
        vec3 momentum = vec3(0.0);
        float mass = 0.0;
        for (int i = 0; i < vertexCount; ++i) {
            float share = inertia(i).z;
            momentum += texelFetch(velocities, stateTexel(i, own.y), 0).xyz * share;
            mass += share;
        }
        vec3 mean = momentum / mass;
        v += thrustedVelocity(mean, whole == 1) - mean;
    }
    newVelocity = vec4(v, 0.0);
}
