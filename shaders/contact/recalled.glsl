// What a sphere has touched since before it came to rest (contact/memory.glsl). Needs `known` and `listStride`.
uniform usamplerBuffer partners;  // oldLists
uniform usamplerBuffer slots;     // of a sphere

int oldCount(int sphere)
{
    return int(texelFetch(known, sphere).w);
}

// Returns the slot of the other sphere.
int oldPartner(int sphere, int e)
{
    return int(texelFetch(slots, int(texelFetch(partners, e * listStride + sphere).x)).x);
}
