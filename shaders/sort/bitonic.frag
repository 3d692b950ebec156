// A pass of bitonic sort with two pairs a texel (UberFlow, section 4.3.3; src/sort/network_sort.h): the smaller key goes to
// the smaller place.
uniform usampler2D pairs;  // xy key and index of the even pair, zw of the odd one
uniform int count;         // pairs past it stay
uniform ivec2 mask;        // of the texel's place: the other one's
uniform bool crossed, sortedBefore, sortedAfter;

layout(location = 0) out uvec4 kept;

// Whether pair a has to stand before b.
bool isBefore(uvec2 a, uvec2 b)
{
#ifdef TIES_BY_INDEX
    return a.x < b.x || (a.x == b.x && a.y < b.y);
#else
    return a.x < b.x;
#endif
}

uvec4 sortedTexel(uvec4 texel, int odd)
{
    return isBefore(texel.zw, texel.xy) && odd < count ? texel.zwxy : texel;
}

void main()
{
    ivec2 size = textureSize(pairs, 0);
    ivec2 here = ivec2(gl_FragCoord.xy), partner = here ^ mask;
    int i = 2 * (here.y * size.x + here.x), j = 2 * (partner.y * size.x + partner.x);  // of the even pairs
    bool lower = i < j;
    uvec4 own = texelFetch(pairs, here, 0);
    uvec4 other = texelFetch(pairs, j < count ? partner : here, 0);
    if (sortedBefore) {
        own = sortedTexel(own, i + 1);
        other = sortedTexel(other, j + 1);
    }
    if (crossed) other = other.zwxy;
    // The pairs that are compared: i and j, i + 1 and j + 1; crossed, i and j + 1, i + 1 and j.
    int cross = int(crossed);
    bvec2 inside = lessThan(max(ivec2(i, i + 1), ivec2(j + cross, j + 1 - cross)), ivec2(count));
    if (inside.x && (lower ? isBefore(other.xy, own.xy) : isBefore(own.xy, other.xy))) own.xy = other.xy;
    if (inside.y && (lower ? isBefore(other.zw, own.zw) : isBefore(own.zw, other.zw))) own.zw = other.zw;
    kept = sortedAfter ? sortedTexel(own, i + 1) : own;
}
