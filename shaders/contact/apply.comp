// Adds the impulses and shifts of contact to the vertices of one group in the state.
//   without TRIANGLES: one lane per slot in contact, which is that of a vertex, and nothing else acts on it
//   TRIANGLES: one lane per vertex, on which the spheres of the triangles around it act as well
#include "contact/shape.glsl"

uniform usamplerBuffer counts;
uniform samplerBuffer impulses;  // kg m/s
uniform samplerBuffer shifts;    // kg m
uniform samplerBuffer known;     // kg m/s: what is to act as a force over the next step
uniform float stepTime;          // s
uniform samplerBuffer oldRecords;

layout(std430, binding = 0) buffer State { float state[]; };
layout(std430, binding = 1) writeonly buffer Loads { vec4 loads[]; };  // m/s^2, by sphere

// Adds to a vertex: m/s, m, m/s^2.
void change(int molecule, int vertex, vec3 velocity, vec3 shift, vec3 load)
{
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int c = 0; c < 3; ++c) {
        int place = floatIndex(first, 3 * vertex + c);
        state[place] += shift[c];
        place = floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * vertex + c);
        state[place] += velocity[c];
    }
    loads[firstSphere + molecule * SPHERES + vertex] = vec4(load, 0.0);
#ifdef HISTORY
    // the same word for all vertices of a molecule: its next step starts anew (fused/bdf2.glsl)
    state[floatIndex(first + 2 * POSITION_ELEMENTS * BLOCK, 0)] = NO_HISTORY;
#endif
}

float weightOf(int molecule, int vertex)
{
    return weightOf(shapeOf(vertex), texelFetch(oldRecords, molecule).w < 0.0);
}

#ifdef RIGID
#include "contact/body_sums.glsl"

uniform usamplerBuffer slots;  // of a sphere

void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    if (lane >= partSpheres) return;
    int molecule = lane / SPHERES;
    int moleculeSphere = firstSphere + molecule * SPHERES;
    BodyMotion velocity = BodyMotion(vec3(0.0), vec3(0.0));
    BodyMotion shift = velocity;
    BodyMotion load = velocity;
    bool touched = false;
    for (int j = 0; j < SPHERES; ++j) {
        int slot = int(texelFetch(slots, moleculeSphere + j).x);
        if (texelFetch(counts, slot).x > 0u) {
            touched = true;
            add(velocity, moleculeSphere + j, texelFetch(impulses, slot).xyz);
            add(shift, moleculeSphere + j, texelFetch(shifts, slot).xyz);
            add(load, moleculeSphere + j, texelFetch(known, slot).xyz / stepTime);
        }
    }
    if (!touched) return;
    BodySphere at = bodySphereAt(firstSphere + lane);
    change(molecule, lane - molecule * SPHERES, motionAt(at, velocity), motionAt(at, shift), motionAt(at, load));
}
#elif defined(TRIANGLES)
uniform usamplerBuffer slots;  // of a sphere

void main()
{
    int vertices = partSpheres / SPHERES * VERTICES;
    int lane = min(int(gl_GlobalInvocationID.x), vertices - 1);
    bool inside = int(gl_GlobalInvocationID.x) < vertices;
    int molecule = lane / VERTICES;
    int vertex = lane - molecule * VERTICES;
    int sphere = firstSphere + molecule * SPHERES;
    vec4 shape = shapeOf(vertex);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    vec3 load = vec3(0.0);
    bool touched = false;
    int slot = int(texelFetch(slots, sphere + vertex).x);
    if (inside && texelFetch(counts, slot).x > 0u) {
        touched = true;
        impulse = texelFetch(impulses, slot).xyz;
        shift = texelFetch(shifts, slot).xyz;
        load = texelFetch(known, slot).xyz;
    }
    int left = inside ? int(shape.w) : 0;
    for (int i = 0; i < left; ++i) {
        slot = int(texelFetch(slots, sphere + int(shapeOf(int(shape.z) + i).x)).x);
        if (texelFetch(counts, slot).x > 0u) {
            touched = true;
            impulse += texelFetch(impulses, slot).xyz / 3.0;
            shift += texelFetch(shifts, slot).xyz / 3.0;
            load += texelFetch(known, slot).xyz / 3.0;
        }
    }
    while (touched) {
        float weight = weightOf(molecule, vertex);
        change(molecule, vertex, impulse * weight, shift * weight, load * (weight / stepTime));
        touched = false;
    }
}
#else
#include "contact/touching.glsl"

uniform usamplerBuffer sorted;  // by slot: y its sphere

void main()
{
    int slot = touchingSlot();
    int lane = slot < 0 ? -1 : int(texelFetch(sorted, slot).y) - firstSphere;
    bool touched = lane >= 0 && lane < partSpheres;
    while (touched) {
        int molecule = lane / SPHERES;
        int vertex = lane - molecule * SPHERES;
        float weight = weightOf(molecule, vertex);
        change(molecule, vertex, texelFetch(impulses, slot).xyz * weight, texelFetch(shifts, slot).xyz * weight,
               texelFetch(known, slot).xyz * (weight / stepTime));
        touched = false;
    }
}
#endif
