// Totals by slot (contact/totals.glsl) become changes of the spheres of a molecule, of which each may move others, because they
// lie on triangles of the same vertices or on a rigid body (RIGID). Needs contact/shape.glsl.
#include "contact/totals.glsl"

uniform UINTS counts;
uniform TOTALS totals;
#ifdef APPLIES
uniform FLOATS known;  // contact/memory.glsl: what acts as a force over the next step
#else
uniform TOTALS earlier;   // the totals an iteration before
uniform float momentum;   // contact/relax.glsl
#endif
uniform VALUES oldRecords;

// What contacts do to a sphere, or the changes that this makes: m/s, m and m/s.
struct Total {
    vec3 impulse;  // N s
    vec3 shift;    // kg m
    vec3 load;     // N s, over the next step
};

Total noTotal()
{
    return Total(vec3(0.0), vec3(0.0), vec3(0.0));
}

// Adds so large a part of b.
void add(inout Total a, Total b, float part)
{
    a.impulse += b.impulse * part;
    a.shift += b.shift * part;
    a.load += b.load * part;
}

#ifdef APPLIES
#ifdef RIGID
#include "contact/flags.glsl"

uniform UINTS motions;
uniform UINTS effectiveCounts;  // contact/respond.glsl

// Whether contact alone holds a sphere off the colliders in the next step: its body touches others, and it is so slow that it
// reaches none that is not known as near (contact/state_sphere.glsl). `changed`: how contact has changed its velocity, m/s.
bool holds(int sphere, vec3 changed, float stepTime)
{
    int slot = slotOf(sphere);
#ifdef TEXTURES
    uvec3 motion = fetch(motions, slot).xyz;
#else
    uvec3 motion = fetch(motions, sphere).xyz;
#endif
    float radius = uintBitsToFloat(fetch(cells, slot).w & ~RESTS);
    return uintBitsToFloat(fetch(effectiveCounts, slot).x) > 0.0 &&
           length(uintBitsToFloat(motion) + changed) * stepTime < 0.25 * radius;
}
#endif

// Returns what acts on the vertex of a sphere over the next step, m/s^2; in w below 0: contact alone holds it off the colliders.
vec4 loadOf(int sphere, Total by, float stepTime)
{
    float alone = 0.0;
#ifdef RIGID
    if (holds(sphere, by.impulse, stepTime)) alone = -1.0;
#endif
    return vec4(by.load / stepTime, alone);
}
#endif

Total totalAt(int sphere)
{
    int slot = slotOf(sphere);
    if (fetch(counts, slot).x == 0u) return noTotal();
    Total now = Total(firstTotal(totals, slot), secondTotal(totals, slot), vec3(0.0));
#ifdef APPLIES
#ifdef TEXTURES
    now.load = fetch(known, slot).xyz;
#else
    now.load = fetch(known, sphere).xyz;
#endif
#else
    if (momentum != 0.0) {
        now.impulse += (now.impulse - firstTotal(earlier, slot)) * momentum;
        now.shift += (now.shift - secondTotal(earlier, slot)) * momentum;
    }
#endif
    return now;
}

#ifdef RIGID
#include "contact/body_sums.glsl"

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
        int sphere = firstSphere + molecule * SPHERES + k;
        Total total = totalAt(sphere);
        BodySphere at = bodySphereAt(sphere);
        add(sum.impulse, at, total.impulse);
        add(sum.shift, at, total.shift);
        add(sum.load, at, total.load);
    }
    return sum;
}

// Returns how that changes sphere k of its molecule.
Total changeIn(BodyTotal body, int molecule, int k)
{
    BodySphere at = bodySphereAt(firstSphere + molecule * SPHERES + k);
#ifdef APPLIES
    vec3 shift = wayAt(at, body.shift);
#else
    vec3 shift = motionAt(at, body.shift);
#endif
    return Total(motionAt(at, body.impulse), shift, motionAt(at, body.load));
}

// Returns how they change sphere k of a molecule.
Total changeOf(int molecule, int k)
{
    return changeIn(totalOfBody(molecule), molecule, k);
}
#else
// Returns how its own contacts and those of the triangles around it change a vertex.
Total changeOfVertex(int vertex, int first, bool released)
{
    vec4 shape = shapeOf(vertex);
    Total sum = totalAt(first + vertex);
    for (int i = 0; i < int(shape.w); ++i) add(sum, totalAt(first + int(shapeOf(int(shape.z) + i).x)), 1.0 / 3.0);
    Total change = noTotal();
    add(change, sum, weightOf(shape, released));
    return change;
}

// Returns how they change sphere k of a molecule.
Total changeOf(int molecule, int k)
{
    int first = firstSphere + molecule * SPHERES;
    bool released = valueOf(oldRecords, molecule).w < 0.0;
    vec4 shape = shapeOf(k);
    if (k < VERTICES) return changeOfVertex(k, first, released);
    Total change = noTotal();
    for (int c = 0; c < 3; ++c) add(change, changeOfVertex(int(shape[c]), first, released), 1.0 / 3.0);
    return change;
}
#endif
