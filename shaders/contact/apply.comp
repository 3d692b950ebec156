// Adds what contact does to the vertices of one group in the state, and leaves what acts on them over the next step.
//   MANY: a lane a vertex, on which the contacts of several spheres act (contact/spread.glsl)
//   else: a lane a slot that takes part, which is that of a vertex, and nothing else acts on it
#include "contact/shape.glsl"
#ifdef MANY
#include "contact/resting.glsl"
#endif
#include "contact/spread.glsl"

uniform float stepTime;     // s, of a contact step
uniform float restSpeed;    // m/s
uniform float substepTime;  // s

layout(std430) buffer State { float state[]; };
#ifdef REMEMBERS
// By sphere: loadOf(); in w above 0: its molecule rests.
layout(std430) writeonly buffer Loads { vec4 loads[]; };
#endif

void change(int molecule, int vertex, Total by)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec3 v;
    for (int c = 0; c < 3; ++c) {
        int place = floatIndex(first, 3 * vertex + c);
        state[place] += by.shift[c];
        place = floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * vertex + c);
        v[c] = state[place] + by.impulse[c];
        state[place] = v[c];
    }
#ifdef REMEMBERS
    int sphere = firstSphere + molecule * SPHERES + vertex;
    loads[sphere] = loadOf(sphere, by, stepTime);
#endif
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
    int lane = int(gl_GlobalInvocationID.x);
    int molecule = lane / VERTICES;
    if (molecule * SPHERES >= partSpheres) return;
    if (rests(slotOf(firstSphere + molecule * SPHERES))) return;
    Total by = changeOf(molecule, lane - molecule * VERTICES);
    if (by.impulse != vec3(0.0) || by.shift != vec3(0.0) || by.load != vec3(0.0)) change(molecule, lane - molecule * VERTICES, by);
}
#else
#include "contact/touching.glsl"

uniform usamplerBuffer sorted;  // by slot: y its sphere

void main()
{
    int slot = touchingSlot();
    int lane = slot < 0 ? -1 : int(texelFetch(sorted, slot).y) - firstSphere;
    if (lane < 0 || lane >= partSpheres) return;
    int molecule = lane / SPHERES;
    Total by = noTotal();
    add(by, Total(firstTotal(totals, slot), secondTotal(totals, slot), texelFetch(known, firstSphere + lane).xyz),
        weightOf(shapeOf(lane - molecule * SPHERES), texelFetch(oldRecords, molecule).w < 0.0));
    change(molecule, lane - molecule * SPHERES, by);
}
#endif
