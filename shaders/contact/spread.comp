// A lane a sphere of one group, or with RIGID a molecule: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/resting.glsl"
#include "contact/spread.glsl"

uniform usamplerBuffer motions;

layout(std430) writeonly buffer MotionsNow { vec4 motionsNow[]; };

void store(int sphere, Total change)
{
    int slot = slotOf(sphere);
    motionsNow[2 * slot] = vec4(uintBitsToFloat(texelFetch(motions, sphere).xyz) + change.impulse, 0.0);
    motionsNow[2 * slot + 1] = vec4(change.shift, 0.0);
}

#ifdef RIGID
void main()
{
    int molecule = min(int(gl_GlobalInvocationID.x), partSpheres / SPHERES - 1);
    int first = firstSphere + molecule * SPHERES;
    bool moves = !rests(slotOf(first));
    while (moves) {
        BodyTotal body = totalOfBody(molecule);
        for (int k = 0; k < SPHERES; ++k) store(first + k, changeIn(body, molecule, k));
        moves = false;
    }
}
#else
void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int sphere = firstSphere + lane;
    bool moves = !rests(slotOf(sphere));
    while (moves) {
        store(sphere, changeOf(molecule, lane - molecule * SPHERES));
        moves = false;
    }
}
#endif
