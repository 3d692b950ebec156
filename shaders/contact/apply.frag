// apply: a texel a vertex of one group, into the state: what its sphere's contacts do.
#include "state/textures.glsl"
#include "state/numbered.glsl"

uniform UINTS slots;      // of a sphere
uniform UINTS counts;
uniform FLOATS impulses;  // kg m/s
uniform FLOATS shifts;    // kg m
uniform int firstSphere;  // of the group

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 x = texelFetch(positions, texel, 0).xyz;
    vec3 v = texelFetch(velocities, texel, 0).xyz;
    vec4 ownInertia = inertia(own.x);
    if (!isPadding(own.y) && !isHeld(ownInertia, own.y)) {
        int slot = int(fetch(slots, firstSphere + own.y * vertexCount + own.x).x);
        if (fetch(counts, slot).x > 0u) {
            x += fetch(shifts, slot).xyz * ownInertia.x;
            v += fetch(impulses, slot).xyz * ownInertia.x;
        }
    }
    newPosition = vec4(x, 0.0);
    newVelocity = vec4(v, 0.0);
}
