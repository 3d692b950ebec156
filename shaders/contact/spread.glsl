// Where one sphere's impulse moves others, because they lie on triangles of the same vertices or on a rigid body (RIGID): the
// velocity that the impulses so far make of a sphere's. Needs contact/shape.glsl.
uniform UINTS slots;      // of a sphere
uniform UINTS counts;
uniform FLOATS impulses;  // N s, by slot
uniform FLOATS earlier;   // the same an iteration before
uniform float momentum;   // contact/relax.glsl
uniform VALUES oldRecords;

uniform FLOATS shifts;
uniform FLOATS earlierShifts;
bool ofShifts = false;

vec3 impulseAt(int sphere)
{
    int slot = int(fetch(slots, sphere).x);
    if (fetch(counts, slot).x == 0u) return vec3(0.0);
    if (ofShifts) {
        vec3 now = fetch(shifts, slot).xyz;
        return now + (now - fetch(earlierShifts, slot).xyz) * momentum;
    }
    vec3 now = fetch(impulses, slot).xyz;
    return now + (now - fetch(earlier, slot).xyz) * momentum;
}

// m/s, of what the contacts of a vertex and of the triangles around it have changed.
vec3 changeOf(int vertex, int moleculeSphere, bool released)
{
    vec4 shape = shapeOf(vertex);
    vec3 sum = impulseAt(moleculeSphere + vertex);
    for (int i = 0; i < int(shape.w); ++i) sum += impulseAt(moleculeSphere + int(shapeOf(int(shape.z) + i).x)) / 3.0;
    return sum * weightOf(shape, released);
}

#ifdef RIGID
#include "contact/body_sums.glsl"

vec3 velocityChange(int molecule, int k)
{
    int moleculeSphere = firstSphere + molecule * SPHERES;
    BodyMotion motion = BodyMotion(vec3(0.0), vec3(0.0));
    for (int j = 0; j < SPHERES; ++j) add(motion, moleculeSphere + j, impulseAt(moleculeSphere + j));
    return motionAt(bodySphereAt(moleculeSphere + k), motion);
}
#else
// m/s, of sphere k of a molecule.
vec3 velocityChange(int molecule, int k)
{
    int moleculeSphere = firstSphere + molecule * SPHERES;
    bool released = valueOf(oldRecords, molecule).w < 0.0;
    vec4 shape = shapeOf(k);
    bool isVertex = k < VERTICES;
    vec3 change = changeOf(isVertex ? k : int(shape.x), moleculeSphere, released);
    if (!isVertex) {
        change = (change + changeOf(int(shape.y), moleculeSphere, released) +
                  changeOf(int(shape.z), moleculeSphere, released)) / 3.0;
    }
    return change;
}
#endif
