// The gains of the vertices of one group from contact, in fragments, and the loads on them over the next step.
#include "state/lanes.glsl"
#include "contact/flags.glsl"
#pragma reads slots counts motions totals warmStart
#pragma writes gains loads

uniform float stepTime;  // s, of a contact step

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
