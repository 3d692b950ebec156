// sums: a level of a tree over the bits of places, in rows of 32 siblings, each of which stands for 32 nodes of the
// level below. xy: how many bits are set in the siblings before this one; zw: in this one. The first of each pair
// counts free places, the second those in which one died.
uniform usampler2D below;  // with WORDS the bits, a word for each; else sums
uniform int belowRows;

layout(location = 0) out uvec4 sums;

#ifdef WORDS
uint bitsIn(uint word)
{
    word -= (word >> 1u) & 0x55555555u;
    word = (word & 0x33333333u) + ((word >> 2u) & 0x33333333u);
    return (((word + (word >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u;
}

uvec2 countIn(int sibling, int row)
{
    uvec2 words = texelFetch(below, ivec2(sibling, row), 0).xy;
    return uvec2(bitsIn(words.x), bitsIn(words.y));
}
#else
uvec2 countIn(int sibling, int row)
{
    int child = row * 32 + sibling;
    if (child >= belowRows) return uvec2(0u);
    uvec4 last = texelFetch(below, ivec2(31, child), 0);
    return last.xy + last.zw;
}
#endif

void main()
{
    ivec2 own = ivec2(gl_FragCoord.xy);
    uvec2 before = uvec2(0u);
    for (int sibling = 0; sibling < own.x; ++sibling) before += countIn(sibling, own.y);
    sums = uvec4(before, countIn(own.x, own.y));
}
