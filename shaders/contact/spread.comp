// A lane a sphere of one group: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/spread.glsl"

#ifdef RESTING
#include "contact/resting.glsl"
#endif

uniform usamplerBuffer motions;

layout(std430, binding = 0) writeonly buffer MotionsNow { vec4 motionsNow[]; };

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int sphere = firstSphere + lane;
    int slot = int(texelFetch(slots, sphere).x);
    Total change = noTotal();
    bool moves = true;
#ifdef RESTING
    moves = !rests(slot);
#endif
    while (moves) {
        change = changeOf(molecule, lane - molecule * SPHERES);
        moves = false;
    }
    motionsNow[2 * slot] = vec4(uintBitsToFloat(texelFetch(motions, sphere).xyz) + change.impulse, 0.0);
    motionsNow[2 * slot + 1] = vec4(change.shift, 0.0);
}
