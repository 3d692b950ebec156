// A pass of odd-even merge sort, a pair a texel (Latta, figure 4; src/sort/network_sort.h): the smaller key goes to the
// smaller place.
uniform usampler2D pairs;  // x key, y index
uniform int count;
uniform int run, reach;
uniform int rowBits;  // of the width, a power of two

layout(location = 0) out uvec2 kept;

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy);
    int width = textureSize(pairs, 0).x;
    int i = here.y * width + here.x;
    int offset = i - (reach & (run - 1));
    bool lower = (offset & reach) == 0;
    int partner = lower ? i + reach : i - reach;
    // in the same block of two runs, and neither past the last
    bool compared = offset >= 0 && max(i, partner) < count && ((i ^ partner) & ~(2 * run - 1)) == 0;
    if (!compared) partner = i;
    uvec2 own = texelFetch(pairs, here, 0).xy;
    uvec2 other = texelFetch(pairs, ivec2(partner & (width - 1), partner >> rowBits), 0).xy;
    bool swapped = lower ? other.x < own.x : other.x > own.x;
    kept = compared && swapped ? other : own;
}
