// Three floats a vertex without gaps in 4-vectors: how the fused step stores positions, velocities and normals
// (shaders/fused/state.glsl). With compute the 4-vectors of a molecule lie in a buffer, molecules in blocks of BLOCK; in
// fragments (LAYERED) in the layers of an array texture of STATE_WIDTH columns, a texel a molecule. Set by C++
// (BufferLayout::defines): BLOCK, POSITION_ELEMENTS, STATE_ELEMENTS.
#ifdef LAYERED
#define VALUES sampler2DArray

int firstElement(int molecule, int elements)
{
    return molecule;
}

vec4 element(sampler2DArray values, int first, int e)
{
    return texelFetch(values, ivec3(first % STATE_WIDTH, first / STATE_WIDTH, e), 0);
}

vec4 valueOf(sampler2DArray values, int molecule)
{
    return element(values, molecule, 0);
}
#else
#define VALUES samplerBuffer

// Where a molecule's values begin that takes so many `elements`.
int firstElement(int molecule, int elements)
{
    return (molecule / BLOCK) * (BLOCK * elements) + molecule % BLOCK;
}

// 4-vector e of the molecule whose values begin at `first`.
vec4 element(samplerBuffer values, int first, int e)
{
    return texelFetch(values, first + e * BLOCK);
}

// The only 4-vector of a molecule.
vec4 valueOf(samplerBuffer values, int molecule)
{
    return texelFetch(values, molecule);
}

// Component number % 4 of 4-vector number / 4 of a molecule's values, in a buffer of floats.
int floatIndex(int first, int number)
{
    return (first + (number / 4) * BLOCK) * 4 + number % 4;
}
#endif

// A vertex, which may lie across two 4-vectors, of those from `begin` on: 0 for positions, POSITION_ELEMENTS for
// velocities.
vec3 packedVertex(VALUES values, int first, int begin, int vertex)
{
    int number = 3 * vertex;
    vec4 low = element(values, first, begin + number / 4);
    vec4 high = element(values, first, begin + (number + 2) / 4);
    int shift = number % 4;
    return shift == 0 ? low.xyz : shift == 1 ? low.yzw : shift == 2 ? vec3(low.zw, high.x) : vec3(low.w, high.xy);
}

// Where molecules are born and die: x age, y length of life, s, at most 0 where the place is free. These are the w of the
// last 4-vector of the positions and of the velocities or, where those are full and STATE_ELEMENTS is odd, in one more.
vec2 packedLife(VALUES values, int first)
{
    if (STATE_ELEMENTS % 2 == 1) return element(values, first, STATE_ELEMENTS - 1).xy;
    return vec2(element(values, first, POSITION_ELEMENTS - 1).w, element(values, first, 2 * POSITION_ELEMENTS - 1).w);
}
