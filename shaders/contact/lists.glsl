// The list of a slot's contacts, of which it holds LIST at most (set by C++): entry e of slot s is lists[e * listStride + s],
// or with TEXTURES one of four numbers of layer e / 4. `counts` may be more than a list holds.
uniform UINTS counts;

#ifdef TEXTURES
uniform usampler2DArray lists;

int entryOf(int slot, int e)
{
    return int(texelFetch(lists, ivec3(texelOf(slot), e >> 2), 0)[e & 3]);
}
#else
uniform usamplerBuffer lists;
uniform int listStride;

int entryOf(int slot, int e)
{
    return int(texelFetch(lists, e * listStride + slot).x);
}
#endif
