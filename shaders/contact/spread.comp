// A lane a sphere of one group, or with RIGID a molecule: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/spread.glsl"

#ifdef RESTING
#include "contact/resting.glsl"
#endif

uniform usamplerBuffer motions;

layout(std430, binding = 0) writeonly buffer MotionsNow { vec4 motionsNow[]; };

void store(int sphere, int slot, Total change)
{
    motionsNow[2 * slot] = vec4(uintBitsToFloat(texelFetch(motions, sphere).xyz) + change.impulse, 0.0);
    motionsNow[2 * slot + 1] = vec4(change.shift, 0.0);
}

int slotOf(int sphere)
{
    return int(texelFetch(slots, sphere).x);
}

bool moves(int sphere)
{
#ifdef RESTING
    return !rests(slotOf(sphere));
#else
    return true;
#endif
}

#ifdef RIGID
void main()
{
    int molecule = min(int(gl_GlobalInvocationID.x), partSpheres / SPHERES - 1);
    int first = firstSphere + molecule * SPHERES;
    BodyMotion none = BodyMotion(vec3(0.0), vec3(0.0));
    BodyTotal body = BodyTotal(none, none, none);
    bool movesYet = moves(first);
    while (movesYet) {
        body = totalOfBody(molecule);
        movesYet = false;
    }
    for (int k = 0; k < SPHERES; ++k) store(first + k, slotOf(first + k), changeIn(body, molecule, k));
}
#else
void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int sphere = firstSphere + lane;
    Total change = noTotal();
    bool movesYet = moves(sphere);
    while (movesYet) {
        change = changeOf(molecule, lane - molecule * SPHERES);
        movesYet = false;
    }
    store(sphere, slotOf(sphere), change);
}
#endif
