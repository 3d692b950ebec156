// Which molecule an instance is. Variants: ORDERED (not as they are numbered), SLABS (only those of one slab of
// depth), SLAB_DRAWS (the same, where each slab has a draw of its own), BATCH (so many molecules an instance, of CORNERS
// vertices each). Needs state/molecule.glsl.
#ifdef BATCH
uniform int drawnCount;  // molecules; the last instance may be left with fewer

int drawnPlace()
{
    return gl_InstanceID * BATCH + gl_VertexID / CORNERS;
}
#else
int drawnPlace()
{
    return gl_InstanceID;
}
#endif

#ifdef ORDERED
#include "render/order.glsl"
#ifdef SLABS
uniform usampler2D slabs;  // texel s: x the first key of slab s, y the first one past it
uniform int slab;
#endif
#ifdef SLAB_DRAWS
uniform usamplerBuffer slabDraws;  // src/render/slab_draws.h
uniform int slab;
#endif

// False: not drawn now.
bool findDrawn(out int molecule)
{
#ifdef SLAB_DRAWS
    int place = int(texelFetch(slabDraws, 8 * slab + 5).x) + drawnPlace();
    int end = int(texelFetch(slabDraws, 8 * slab + 6).x);
#elif defined(BATCH)
    int place = drawnPlace(), end = drawnCount;
#else
    int place = drawnPlace(), end = place + 1;
#endif
    uvec2 pair = orderAt(min(place, end - 1));
    molecule = int(pair.y);
#ifdef SLABS
    uvec2 bounds = texelFetch(slabs, ivec2(slab, 0), 0).xy;
    return place < end && pair.x >= bounds.x && pair.x < bounds.y && isAlive(molecule);
#else
    return place < end && isAlive(molecule);
#endif
}
#elif defined(BATCH)
bool findDrawn(out int molecule)
{
    int place = drawnPlace();
    molecule = min(place, drawnCount - 1);
    return place < drawnCount && isAlive(molecule);
}
#else
bool findDrawn(out int molecule)
{
    molecule = drawnPlace();
    return isAlive(molecule);
}
#endif
