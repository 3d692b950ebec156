// A lane a sphere of one group, with spheres on triangles: the effective count (contact/effective.glsl) of the contacts that
// act on the same vertices as its own.
#include "contact/shape.glsl"
#include "physics/pair.glsl"

uniform usamplerBuffer slots;
uniform usamplerBuffer counts;
uniform samplerBuffer normals;  // two texels a slot: NormalSum

layout(std430, binding = 0) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };

int moleculeSphere;

void add(inout NormalSum sum, int k)
{
    int slot = int(texelFetch(slots, moleculeSphere + k).x);
    if (texelFetch(counts, slot).x == 0u) return;
    sum.diagonal += texelFetch(normals, 2 * slot).xyz;
    sum.beside += texelFetch(normals, 2 * slot + 1).xyz;
}

float countOf(int vertex)
{
    vec4 shape = shapeOf(vertex);
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    add(sum, vertex);
    for (int i = 0; i < int(shape.w); ++i) add(sum, int(shapeOf(int(shape.z) + i).x));
    return largestEigenvalue(sum);
}

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    moleculeSphere = firstSphere + molecule * SPHERES;
    vec4 shape = shapeOf(k);
    float most = countOf(k < VERTICES ? k : int(shape.x));
    if (k >= VERTICES) most = max(most, max(countOf(int(shape.y)), countOf(int(shape.z))));
    effectiveCounts[int(texelFetch(slots, moleculeSphere + k).x)] = floatBitsToUint(most);
}
