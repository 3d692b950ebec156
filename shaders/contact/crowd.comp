// A lane a sphere of one group, with spheres on triangles: how many contacts act on the same vertices as its own.
#include "contact/shape.glsl"

uniform usamplerBuffer slots;
uniform usamplerBuffer counts;
uniform int firstSphere;
uniform int partSpheres;

layout(std430, binding = 0) writeonly buffer Crowds { uint newCrowds[]; };

int moleculeSphere;

uint countAt(int k)
{
    return texelFetch(counts, int(texelFetch(slots, moleculeSphere + k).x)).x;
}

uint crowdOf(int vertex)
{
    vec4 shape = shapeOf(vertex);
    uint sum = countAt(vertex);
    for (int i = 0; i < int(shape.w); ++i) sum += countAt(int(shapeOf(int(shape.z) + i).x));
    return sum;
}

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    moleculeSphere = firstSphere + molecule * SPHERES;
    vec4 shape = shapeOf(k);
    uint crowd = crowdOf(k < VERTICES ? k : int(shape.x));
    if (k >= VERTICES) crowd = max(crowd, max(crowdOf(int(shape.y)), crowdOf(int(shape.z))));
    newCrowds[int(texelFetch(slots, moleculeSphere + k).x)] = crowd;
}
