// Adds what contact does to the vertices of one group in the state, and leaves what acts on them over the next step.
//   MANY: a lane a vertex, on which the contacts of several spheres act (contact/spread.glsl)
//   else: a lane a slot that takes part, which is that of a vertex, and nothing else acts on it
#include "contact/shape.glsl"
#include "contact/spread.glsl"

uniform float stepTime;   // s, of a contact step
uniform float restSpeed;  // m/s

layout(std430, binding = 0) buffer State { float state[]; };
layout(std430, binding = 1) writeonly buffer Loads { vec4 loads[]; };  // m/s^2, by sphere

#ifdef HISTORY
bool isImpact(vec3 change, float rest)
{
    return length(change) > 0.1 * rest;
}
#endif

void change(int molecule, int vertex, Total by)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int c = 0; c < 3; ++c) {
        int place = floatIndex(first, 3 * vertex + c);
        state[place] += by.shift[c];
        place = floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * vertex + c);
        state[place] += by.impulse[c];
    }
#ifdef REMEMBERS
    loads[firstSphere + molecule * SPHERES + vertex] = vec4(by.load / stepTime, 0.0);
#endif
#ifdef HISTORY
    // What goes on nearly as it began has this for a part of its last substep; after an impact the next starts anew
    // (fused/bdf2.glsl).
    for (int c = 0; c < 3; ++c) {
        state[floatIndex(first + 2 * POSITION_ELEMENTS * BLOCK, 3 * vertex + c)] += by.shift[c];
        state[floatIndex(first + 3 * POSITION_ELEMENTS * BLOCK, 3 * vertex + c)] += by.impulse[c];
    }
    if (isImpact(by.impulse, restSpeed)) state[floatIndex(first + 2 * POSITION_ELEMENTS * BLOCK, 3 * vertex)] = NO_HISTORY;
#endif
}

#ifdef MANY
void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    int molecule = lane / VERTICES;
    if (molecule * SPHERES >= partSpheres) return;
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
    add(by, Total(firstTotal(totals, slot), secondTotal(totals, slot), texelFetch(known, slot).xyz),
        weightOf(shapeOf(lane - molecule * SPHERES), texelFetch(oldRecords, molecule).w < 0.0));
    change(molecule, lane - molecule * SPHERES, by);
}
#endif
