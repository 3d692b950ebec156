// The list of a slot's contacts, of which it holds LIST at most (set by C++). `counts`: how many a slot has, which may be more
// than its list holds, with the flags of contact/flags.glsl. What is kept of an entry lies at e * listStride + slot, or with TEXTURES
// in layer e; the lists themselves lie there four entries to a texel.
uniform UINTS counts;

#ifdef TEXTURES
#define LISTS usampler2DArray
#define ENTRIES sampler2DArray
#define entry(values, slot, e) texelFetch(values, ivec3(texelOf(slot), e), 0)

int entryIn(LISTS entries, int slot, int e)
{
    return int(texelFetch(entries, ivec3(texelOf(slot), e >> 2), 0)[e & 3]);
}
#else
#define LISTS usamplerBuffer
#define ENTRIES samplerBuffer
#define entry(values, slot, e) texelFetch(values, (e) * listStride + (slot))

uniform int listStride;

int entryIn(LISTS entries, int slot, int e)
{
    return int(texelFetch(entries, e * listStride + slot).x);
}
#endif

uniform LISTS lists;

int entryOf(int slot, int e)
{
    return entryIn(lists, slot, e);
}

// Returns how many of the spheres that a slot touches its list holds.
int listedOf(int slot)
{
    return min(int(fetch(counts, slot).x & CONTACTS), LIST);
}
