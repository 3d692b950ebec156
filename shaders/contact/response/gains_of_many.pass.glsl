// The gains of the vertices of one group from contact, in fragments, and the loads on them over the next step, where the contacts of several
// spheres act on a vertex (contact/response/changes.glsl).
const bool applies = true;
#include "contact/response/changes.glsl"
#pragma writes gains loads

uniform float stepTime;  // s, of a contact step

void main()
{
    int lane = ownLane();
    int sphere = firstNumber + lane;
    int molecule = lane / SPHERES;
    int vertex = lane - molecule * SPHERES;
    Total change = noTotal();
    if (vertex < VERTICES) change = changeOf(molecule, vertex);
    bool any = change.impulse != vec3(0.0) || change.shift != vec3(0.0) || change.load != vec3(0.0);
    putGains(sphere, 0, vec4(change.impulse, any ? 1.0 : 0.0));
    putGains(sphere, 1, vec4(change.shift, 0.0));
    putLoads(sphere, any ? loadOf(sphere, change, stepTime) : vec4(0.0));
}
