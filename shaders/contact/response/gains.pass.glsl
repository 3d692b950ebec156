// The gains of the vertices of one group from contact, in fragments, and the loads on them over the next step.
//   MANY: the contacts of several spheres act on a vertex (contact/response/changes.glsl)
#ifdef MANY
const bool applies = true;
#include "contact/response/changes.glsl"
#else
#include "state/lanes.glsl"
#include "contact/flags.glsl"
#pragma reads slots counts motions totals warmStart
#endif
#pragma writes gains loads

uniform float stepTime;  // s, of a contact step

#ifdef MANY
void main()
{
    int lane = ownLane();
    int sphere = firstNumber + lane;
    int molecule = lane / SPHERES;
    int vertex = lane - molecule * SPHERES;
    Total change = noTotal;
    if (vertex < VERTICES) change = changeOf(molecule, vertex);
    bool any = change.impulse != vec3(0.0) || change.shift != vec3(0.0) || change.load != vec3(0.0);
    putGains(sphere, 0, vec4(change.impulse, any ? 1.0 : 0.0));
    putGains(sphere, 1, vec4(change.shift, 0.0));
    vec3 velocity = uintBitsToFloat(sphereMotionsAt(sphere).xyz) + change.impulse;  // before impacts
    putLoads(sphere, any ? loadOf(sphere, change, velocity, stepTime) : vec4(0.0));
}
#else
void main()
{
    int sphere = firstNumber + ownLane();
    int slot = int(slotsAt(sphere));
    bool any = countsAt(slot) != 0u;
    float weight = any ? withoutFlag(motionsAt(slot).w) : 0.0;
    bool moves = weight > 0.0;
    putGains(sphere, 0, vec4(moves ? totalsAt(slot, 0).xyz * weight : vec3(0.0), any ? 1.0 : 0.0));
    putGains(sphere, 1, vec4(moves ? totalsAt(slot, 1).xyz * weight : vec3(0.0), 0.0));
    putLoads(sphere, vec4(moves ? warmStartAt(slot).xyz * (weight / stepTime) : vec3(0.0), 0.0));
}
#endif
