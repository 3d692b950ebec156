// The list of a slot's contacts, of which it holds LIST at most (set by C++). `counts`: how many a slot
// has, which may be more than the list holds, and RESPONDS (contact/count.glsl). What is
// kept of each entry lies at e * listStride + slot, or with TEXTURES in layer e; the lists themselves there four to a texel.
uniform UINTS counts;
#include "contact/count.glsl"

#ifdef TEXTURES
#define ENTRIES sampler2DArray
#define entry(values, slot, e) texelFetch(values, ivec3(texelOf(slot), e), 0)
uniform usampler2DArray lists;

int entryOf(int slot, int e)
{
    return int(texelFetch(lists, ivec3(texelOf(slot), e >> 2), 0)[e & 3]);
}
#else
#define ENTRIES samplerBuffer
#define entry(values, slot, e) texelFetch(values, (e) * listStride + (slot))
uniform usamplerBuffer lists;
uniform int listStride;

int entryOf(int slot, int e)
{
    return int(texelFetch(lists, e * listStride + slot).x);
}
#endif

// Of the spheres that a slot touches, how many its list holds.
int listedOf(int slot)
{
    return min(int(fetch(counts, slot).x & CONTACTS), LIST);
}
