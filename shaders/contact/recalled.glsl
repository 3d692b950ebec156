// What the sphere of a slot has touched since before it came to rest (contact/memory.glsl). Needs contact/records.glsl,
// `known` and `listStride`.
uniform usamplerBuffer partners;  // oldLists
uniform usamplerBuffer slots;     // of a sphere

int oldCount(int slot)
{
    return int(texelFetch(known, sphereOf(slot)).w);
}

// Returns the slot of the other sphere.
int oldPartner(int slot, int e)
{
    return int(texelFetch(slots, int(texelFetch(partners, e * listStride + sphereOf(slot)).x)).x);
}
