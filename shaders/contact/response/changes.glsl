// Totals by row become changes of the spheres of a molecule, of which each may move others, because they lie on triangles of the same
// vertices or on a rigid body (RIGID). Needs `applies`: whether what contact changes goes into the state, or on to the next iteration.
#include "contact/grid/shape.glsl"
#include "contact/search/responding.glsl"
#include "contact/rest/states.glsl"
#include "contact/response/body.glsl"
#pragma reads totals earlierTotals warmStart cells effectiveCounts motions sphereMotions

uniform float momentum;  // of the iteration (contact/response/iteration.glsl)
uniform VALUES oldRecords;

int moleculeSphere(int molecule)
{
    return firstSphere + molecule * SPHERES;
}

// The sums of a sphere's contacts, or the changes that they make: m/s, m and m/s.
struct Total {
    vec3 impulse;  // N s
    vec3 shift;    // kg m
    vec3 load;     // N s, over the next step
};

const Total noTotal = Total(vec3(0.0), vec3(0.0), vec3(0.0));

// Adds so large a part of b.
void add(inout Total a, Total b, float part)
{
    a.impulse += b.impulse * part;
    a.shift += b.shift * part;
    a.load += b.load * part;
}

vec3 velocityBefore(int sphere)
{
    return uintBitsToFloat(inTextures ? motionsAt(slotOf(sphere)).xyz : sphereMotionsAt(sphere).xyz);
}

// Returns the load on a sphere's vertex over the next step (contact/arrays.txt), of which `velocity` is that after contact, m/s. Contact alone
// holds it off the colliders if its body touches others, and it is so slow that it reaches none that is not known as near
// (contact/grid/near_colliders.glsl).
vec4 loadOf(int sphere, Total change, vec3 velocity, float stepTime)
{
    int slot = slotOf(sphere);
    bool isHeld = RIGID && uintBitsToFloat(effectiveCountsAt(slot)) > 0.0 &&
                  length(velocity) * stepTime < 0.25 * withoutFlag(cellsAt(slot).w);
    return vec4(change.load / stepTime, isHeld ? HELD_BY_CONTACT : AWAKE);
}

Total totalAt(int sphere)
{
    int slot = slotOf(sphere);
    if (countsAt(slot) == 0u) return noTotal;
    int row = rowOf(slot);
    Total total = Total(totalsAt(row, 0).xyz, totalsAt(row, 1).xyz, vec3(0.0));
    if (applies) {
        total.load = warmStartAt(inTextures ? slot : sphere).xyz;
    } else if (momentum != 0.0) {
        total.impulse += (total.impulse - earlierTotalsAt(row, 0).xyz) * momentum;
        total.shift += (total.shift - earlierTotalsAt(row, 1).xyz) * momentum;
    }
    return total;
}

// How they change a body.
struct BodyTotal {
    BodyMotion impulse;
    BodyMotion shift;
    BodyMotion load;
};

BodyTotal totalOfBody(int molecule)
{
    BodyMotion none = BodyMotion(vec3(0.0), vec3(0.0));
    BodyTotal sum = BodyTotal(none, none, none);
    for (int k = 0; k < SPHERES; ++k) {
        int sphere = moleculeSphere(molecule) + k;
        Total total = totalAt(sphere);
        BodySphere own = bodySphereAt(sphere);
        add(sum.impulse, own, total.impulse);
        add(sum.shift, own, total.shift);
        add(sum.load, own, total.load);
    }
    return sum;
}

// Returns how that changes sphere k of its molecule.
Total changeIn(BodyTotal body, int molecule, int k)
{
    BodySphere own = bodySphereAt(moleculeSphere(molecule) + k);
    vec3 shift = applies ? wayAt(own, body.shift) : motionAt(own, body.shift);
    return Total(motionAt(own, body.impulse), shift, motionAt(own, body.load));
}

// Returns how its own contacts and those of the triangles around it change a vertex.
Total changeOfVertex(int vertex, int first, bool released)
{
    vec4 shape = shapeOf(vertex);
    Total sum = totalAt(first + vertex);
    for (int i = 0; i < int(shape.w); ++i) {
        vec4 around = shapeOf(int(shape.z) + i);
        add(sum, totalAt(first + int(around.x)), around.y);
    }
    Total change = noTotal;
    add(change, sum, weightOf(shape, released));
    return change;
}

// Returns how they change sphere k of a molecule.
Total changeOf(int molecule, int k)
{
    if (RIGID) return changeIn(totalOfBody(molecule), molecule, k);
    int first = moleculeSphere(molecule);
    bool released = valueOf(oldRecords, molecule).w < 0.0;
    if (k < VERTICES) return changeOfVertex(k, first, released);
    TrianglePoint point = trianglePoint(shapeOf(k));
    Total change = noTotal;
    for (int c = 0; c < 3; ++c) {
        if (point.parts[c] > 0.0) add(change, changeOfVertex(point.corners[c], first, released), point.parts[c] / point.all);
    }
    return change;
}
