// Adds what contact does to the vertices of one group in the state, and leaves what acts on them over the next step.
//   MANY: a lane a vertex, on which the contacts of several spheres act (contact/response/changes.glsl)
//   else: a lane a slot that takes part, which is that of a vertex, and nothing else acts on it
const bool applies = true;
#include "contact/response/changes.glsl"
#include "contact/response/vertices.glsl"
#include "contact/slots.glsl"
#pragma reads sorted
#pragma writes loads

uniform int partSpheres;
uniform float substepTime;  // s

// Whether it rested when the step began: its step was in vain, and what it has gained counts for nothing.
bool hasRested(int molecule)
{
    return RESTS && rested(slotOf(moleculeSphere(molecule)));
}

void add(int molecule, int vertex, Total change)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec3 place = stateVector(first, 0, vertex) + change.shift;
    vec3 v = (hasRested(molecule) ? vec3(0.0) : stateVector(first, POSITION_ELEMENTS, vertex)) + change.impulse;
    setStateVector(first, 0, vertex, place);
    setMotion(first, vertex, v, length(v) < restSpeed, v * substepTime);
    int sphere = moleculeSphere(molecule) + vertex;
    putLoads(sphere, loadOf(sphere, change, v, stepTime));
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
    bool any = change.impulse != vec3(0.0) || change.shift != vec3(0.0) || change.load != vec3(0.0);
    if (any || hasRested(molecule)) add(molecule, vertex, change);
}
#else
void main()
{
    int slot = ownSlot(0);
    int lane = slot < 0 ? -1 : int(sortedAt(slot).y) - firstSphere;
    if (lane < 0 || lane >= partSpheres) return;
    int molecule = lane / SPHERES;
    int vertex = lane - molecule * SPHERES;
    int row = ownRow(slot);
    Total change = noTotal;
    add(change, Total(totalsAt(row, 0).xyz, totalsAt(row, 1).xyz, warmStartAt(firstSphere + lane).xyz),
        weightOf(shapeOf(vertex), texelFetch(oldRecords, molecule).w < 0.0));
    add(molecule, vertex, change);
}
#endif
