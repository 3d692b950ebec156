// A pass of bitonic sort with two pairs a texel (UberFlow, section 4.3.3; src/sort/network_sort.h): the smaller key goes to
// the smaller place.
uniform usampler2D pairs;  // xy key and index of the even pair, zw of the odd one
uniform int count;         // pairs past it stay
uniform ivec2 mask;        // of the texel's place: the other one's
uniform bool crossed, sortedBefore, sortedAfter;

layout(location = 0) out uvec4 kept;

uvec4 sortedTexel(uvec4 texel, int odd)
{
    return texel.z < texel.x && odd < count ? texel.zwxy : texel;
}

void main()
{
    ivec2 size = textureSize(pairs, 0);
    ivec2 here = ivec2(gl_FragCoord.xy), there = here ^ mask;
    int i = 2 * (here.y * size.x + here.x), j = 2 * (there.y * size.x + there.x);  // of the even pairs
    bool lower = i < j;
    uvec4 own = texelFetch(pairs, here, 0);
    uvec4 other = texelFetch(pairs, j < count ? there : here, 0);
    if (sortedBefore) {
        own = sortedTexel(own, i + 1);
        other = sortedTexel(other, j + 1);
    }
    if (crossed) other = other.zwxy;
    // The pairs that are compared: i and j, i + 1 and j + 1; crossed, i and j + 1, i + 1 and j.
    int cross = int(crossed);
    bvec2 inside = lessThan(max(ivec2(i, i + 1), ivec2(j + cross, j + 1 - cross)), ivec2(count));
    bvec2 less = lessThan(other.xz, own.xz), greater = greaterThan(other.xz, own.xz);
    if (inside.x && (lower ? less.x : greater.x)) own.xy = other.xy;
    if (inside.y && (lower ? less.y : greater.y)) own.zw = other.zw;
    kept = sortedAfter ? sortedTexel(own, i + 1) : own;
}
