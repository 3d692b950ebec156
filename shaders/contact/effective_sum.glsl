// With spheres on triangles: the effective count (contact/effective.glsl) of the contacts that act on the same vertices as a
// sphere's own. Needs contact/shape.glsl.
#include "physics/pair.glsl"

uniform UINTS slots;  // of a sphere
uniform UINTS counts;
#ifdef TEXTURES
uniform sampler2D diagonals;  // by slot: the parts of a NormalSum
uniform sampler2D besides;

NormalSum normalsAt(int slot)
{
    return NormalSum(fetch(diagonals, slot).xyz, fetch(besides, slot).xyz);
}
#else
uniform samplerBuffer normals;  // two texels a slot

NormalSum normalsAt(int slot)
{
    return NormalSum(texelFetch(normals, 2 * slot).xyz, texelFetch(normals, 2 * slot + 1).xyz);
}
#endif

void add(inout NormalSum sum, int sphere)
{
    int slot = int(fetch(slots, sphere).x);
    if (fetch(counts, slot).x == 0u) return;
    NormalSum more = normalsAt(slot);
    sum.diagonal += more.diagonal;
    sum.beside += more.beside;
}

#ifdef RIGID
// All contacts of the molecule act on it.
float effectiveSum(int moleculeSphere, int k)
{
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    float turning = 0.0;
    for (int j = 0; j < SPHERES; ++j) {
        add(sum, moleculeSphere + j);
        int slot = int(fetch(slots, moleculeSphere + j).x);
        if (fetch(counts, slot).x > 0u) turning += texelFetch(normals, 2 * slot).w;
    }
    return largestEigenvalue(sum) + turning;
}
#else
float countOf(int vertex, int moleculeSphere)
{
    vec4 shape = shapeOf(vertex);
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    add(sum, moleculeSphere + vertex);
    for (int i = 0; i < int(shape.w); ++i) add(sum, moleculeSphere + int(shapeOf(int(shape.z) + i).x));
    return largestEigenvalue(sum);
}

// Returns it for sphere k of the molecule whose first is `moleculeSphere`.
float effectiveSum(int moleculeSphere, int k)
{
    vec4 shape = shapeOf(k);
    float most = countOf(k < VERTICES ? k : int(shape.x), moleculeSphere);
    if (k >= VERTICES) most = max(most, max(countOf(int(shape.y), moleculeSphere), countOf(int(shape.z), moleculeSphere)));
    return most;
}
#endif
