// Three floats a vertex without gaps in 4-vectors, molecules in blocks of BLOCK: how the fused path stores positions,
// velocities and normals (shaders/fused/state.glsl). Set by C++ (BufferLayout::defines): BLOCK, POSITION_ELEMENTS,
// STATE_ELEMENTS.

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

// Where molecules are born and die: x age, y length of life, s, at most 0 where the place is free. These are the w of the
// last 4-vector of the positions and of the velocities or, where those are full and STATE_ELEMENTS is odd, in one more.
vec2 packedLife(samplerBuffer values, int first)
{
    if (STATE_ELEMENTS % 2 == 1) return texelFetch(values, first + (STATE_ELEMENTS - 1) * BLOCK).xy;
    return vec2(texelFetch(values, first + (POSITION_ELEMENTS - 1) * BLOCK).w,
                texelFetch(values, first + (2 * POSITION_ELEMENTS - 1) * BLOCK).w);
}

// Component number % 4 of 4-vector number / 4 of a molecule's values, in a buffer of floats.
int floatIndex(int first, int number)
{
    return (first + (number / 4) * BLOCK) * 4 + number % 4;
}
