// A lane a sphere of one group, with spheres on triangles: the velocities that the impulses so far make.
#include "contact/shape.glsl"

uniform usamplerBuffer slots;  // of a sphere
uniform usamplerBuffer counts;
uniform usamplerBuffer motions;
uniform samplerBuffer impulses;  // as in contact/respond.glsl
uniform samplerBuffer earlier;
uniform float momentum;
uniform samplerBuffer oldRecords;

layout(std430, binding = 0) writeonly buffer Velocities { vec4 newVelocities[]; };

int moleculeSphere;  // the first of its molecule

vec3 impulseAt(int k)
{
    int slot = int(texelFetch(slots, moleculeSphere + k).x);
    vec3 impulse = vec3(0.0);
    if (texelFetch(counts, slot).x > 0u) {
        impulse = texelFetch(impulses, slot).xyz;
        if (momentum != 0.0) impulse += (impulse - texelFetch(earlier, slot).xyz) * momentum;
    }
    return impulse;
}

// m/s, of what the contacts of a vertex and of the triangles around it have changed.
vec3 changeOf(int vertex, bool released)
{
    vec4 shape = shapeOf(vertex);
    vec3 sum = impulseAt(vertex);
    for (int i = 0; i < int(shape.w); ++i) sum += impulseAt(int(shapeOf(int(shape.z) + i).x)) / 3.0;
    return sum * weightOf(shape, released);
}

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    moleculeSphere = firstSphere + molecule * SPHERES;
    int slot = int(texelFetch(slots, moleculeSphere + k).x);
    bool released = texelFetch(oldRecords, molecule).w < 0.0;
    vec4 shape = shapeOf(k);
    bool isVertex = k < VERTICES;
    vec3 change = changeOf(isVertex ? k : int(shape.x), released);
    if (!isVertex) change = (change + changeOf(int(shape.y), released) + changeOf(int(shape.z), released)) / 3.0;
    newVelocities[slot] = vec4(uintBitsToFloat(texelFetch(motions, moleculeSphere + k).xyz) + change, 0.0);
}
