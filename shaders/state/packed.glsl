// Three floats a vertex without gaps in 4-vectors, molecules in blocks of BLOCK: how the fused path stores positions,
// velocities and normals (shaders/fused/state.glsl). BLOCK is set by C++.

// The first 4-vector of a molecule that takes so many `elements`.
int firstElement(int molecule, int elements)
{
    return (molecule / BLOCK) * (BLOCK * elements) + molecule % BLOCK;
}

// A vertex, which may lie across two 4-vectors; `first`: of its molecule's values.
vec3 packedVertex(samplerBuffer values, int first, int vertex)
{
    int number = 3 * vertex;
    vec4 low = texelFetch(values, first + (number / 4) * BLOCK);
    vec4 high = texelFetch(values, first + ((number + 2) / 4) * BLOCK);
    int shift = number % 4;
    return shift == 0 ? low.xyz : shift == 1 ? low.yzw : shift == 2 ? vec3(low.zw, high.x) : vec3(low.w, high.xy);
}
