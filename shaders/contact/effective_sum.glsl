// Where one sphere's contacts move others: the effective count (physics/pair.glsl) of the contacts that act on the same vertices
// as a sphere's own, or on the same rigid body (RIGID). Needs contact/shape.glsl.
#include "physics/pair.glsl"

uniform UINTS slots;  // of a sphere
uniform UINTS counts;
#ifdef TEXTURES
uniform sampler2DArray normals;  // by slot, two layers: xyz the parts of a NormalSum, w of the first the turning
#define normalTexel(slot, k) texelFetch(normals, ivec3(texelOf(slot), k), 0)
#else
uniform samplerBuffer normals;   // two texels a slot
#define normalTexel(slot, k) texelFetch(normals, 2 * (slot) + (k))
#endif

float turning = 0.0;  // of the bodies, in what has been added

void add(inout NormalSum sum, int sphere)
{
    int slot = int(fetch(slots, sphere).x);
    if (fetch(counts, slot).x == 0u) return;
    vec4 first = normalTexel(slot, 0);
    sum.diagonal += first.xyz;
    sum.beside += normalTexel(slot, 1).xyz;
    turning += first.w;
}

#ifdef RIGID
// Returns it for sphere k of the molecule whose first is `moleculeSphere`: all contacts of the molecule act on it.
float effectiveSum(int moleculeSphere, int k)
{
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    for (int j = 0; j < SPHERES; ++j) add(sum, moleculeSphere + j);
    return effectiveCount(sum) + turning;
}
#else
float countOf(int vertex, int moleculeSphere)
{
    vec4 shape = shapeOf(vertex);
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    add(sum, moleculeSphere + vertex);
    for (int i = 0; i < int(shape.w); ++i) add(sum, moleculeSphere + int(shapeOf(int(shape.z) + i).x));
    return effectiveCount(sum);
}

float effectiveSum(int moleculeSphere, int k)
{
    vec4 shape = shapeOf(k);
    float most = countOf(k < VERTICES ? k : int(shape.x), moleculeSphere);
    if (k >= VERTICES) most = max(most, max(countOf(int(shape.y), moleculeSphere), countOf(int(shape.z), moleculeSphere)));
    return most;
}
#endif
