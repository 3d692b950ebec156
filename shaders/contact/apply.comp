// Adds the impulses and shifts of contact to the vertices of one group in the state.
//   without TRIANGLES: one lane per slot in contact, which is that of a vertex, and nothing else acts on it
//   TRIANGLES: one lane per vertex, on which the spheres of the triangles around it act as well
#include "contact/shape.glsl"

uniform usamplerBuffer counts;
uniform samplerBuffer impulses;  // kg m/s
uniform samplerBuffer shifts;    // kg m
uniform samplerBuffer oldRecords;

layout(std430, binding = 0) buffer State { float state[]; };

void change(int molecule, int vertex, vec3 impulse, vec3 shift)
{
    float weight = weightOf(shapeOf(vertex), texelFetch(oldRecords, molecule).w < 0.0);
    int first = firstElement(molecule, STATE_ELEMENTS);
    for (int c = 0; c < 3; ++c) {
        int place = floatIndex(first, 3 * vertex + c);
        state[place] += shift[c] * weight;
        place = floatIndex(first + POSITION_ELEMENTS * BLOCK, 3 * vertex + c);
        state[place] += impulse[c] * weight;
    }
#ifdef HISTORY
    // the same word for all vertices of a molecule: its next step starts anew (fused/bdf2.glsl)
    state[floatIndex(first + 2 * POSITION_ELEMENTS * BLOCK, 0)] = NO_HISTORY;
#endif
}

#ifdef TRIANGLES
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
    bool touched = false;
    int slot = int(texelFetch(slots, sphere + vertex).x);
    if (inside && texelFetch(counts, slot).x > 0u) {
        touched = true;
        impulse = texelFetch(impulses, slot).xyz;
        shift = texelFetch(shifts, slot).xyz;
    }
    int left = inside ? int(shape.w) : 0;
    for (int i = 0; i < left; ++i) {
        slot = int(texelFetch(slots, sphere + int(shapeOf(int(shape.z) + i).x)).x);
        if (texelFetch(counts, slot).x > 0u) {
            touched = true;
            impulse += texelFetch(impulses, slot).xyz / 3.0;
            shift += texelFetch(shifts, slot).xyz / 3.0;
        }
    }
    while (touched) {
        change(molecule, vertex, impulse, shift);
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
        change(molecule, lane - molecule * SPHERES, texelFetch(impulses, slot).xyz, texelFetch(shifts, slot).xyz);
        touched = false;
    }
}
#endif
