// Adds what contact does to the vertices of one group in the state, and leaves what acts on them over the next step.
//   MANY: a lane a vertex, on which the contacts of several spheres act (contact/response/changes.glsl)
//   else: a lane a slot that takes part, which is that of a vertex, and nothing else acts on it
const bool applies = true;
#include "contact/response/changes.glsl"
#include "contact/slots.glsl"
#include "contact/search/responding.glsl"
#pragma reads sorted
#pragma writes loads

uniform int partSpheres;
uniform float substepTime;  // s

layout(std430) buffer State { float state[]; };

void add(int molecule, int vertex, Total change)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec3 v;
    for (int c = 0; c < 3; ++c) {
        int place = floatIndex(first, 3 * vertex + c);
        state[place] += change.shift[c];
        place = floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * vertex + c);
        v[c] = state[place] + change.impulse[c];
        state[place] = v[c];
    }
    int sphere = moleculeSphere(molecule) + vertex;
    putLoads(sphere, loadOf(sphere, change, stepTime));
#ifdef HISTORY
    // A slow vertex goes on as if it had moved so before; any other begins anew (fused/bdf2.glsl).
    bool slow = length(v) < restSpeed;
    for (int c = 0; c < 3; ++c) {
        state[floatIndex(first + 2 * POSITION_ELEMENTS * BLOCK, 3 * vertex + c)] = slow ? v[c] * substepTime : NO_HISTORY;
        state[floatIndex(first + 3 * POSITION_ELEMENTS * BLOCK, 3 * vertex + c)] = 0.0;
    }
#endif
}

#ifdef MANY
void main()
{
    if (isBehindLast()) return;
    int lane = ownLane();
    int molecule = lane / VERTICES;
    int vertex = lane - molecule * VERTICES;
    if (rests(slotOf(moleculeSphere(molecule)))) return;
    Total change = changeOf(molecule, vertex);
    if (change.impulse != vec3(0.0) || change.shift != vec3(0.0) || change.load != vec3(0.0)) add(molecule, vertex, change);
}
#else
void main()
{
    int slot = ownSlot(0);
    int lane = slot < 0 ? -1 : int(sortedAt(slot).y) - firstSphere;
    if (lane < 0 || lane >= partSpheres) return;
    int molecule = lane / SPHERES;
    int vertex = lane - molecule * SPHERES;
    Total change = noTotal();
    add(change, Total(totalsAt(slot, 0).xyz, totalsAt(slot, 1).xyz, warmStartAt(firstSphere + lane).xyz),
        weightOf(shapeOf(vertex), texelFetch(oldRecords, molecule).w < 0.0));
    add(molecule, vertex, change);
}
#endif
