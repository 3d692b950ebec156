// Which molecule an instance is. Variants: ORDERED (not as they are numbered), SLABS (only those of one slab of
// depth), SLAB_DRAWS (the same, where each slab has a draw of its own). Needs lib/molecule.glsl.
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
    uvec2 pair = orderAt(int(texelFetch(slabDraws, 8 * slab + 5).x) + gl_InstanceID);
#else
    uvec2 pair = orderAt(gl_InstanceID);
#endif
    molecule = int(pair.y);
#ifdef SLABS
    uvec2 bounds = texelFetch(slabs, ivec2(slab, 0), 0).xy;
    return pair.x >= bounds.x && pair.x < bounds.y && isAlive(molecule);
#else
    return isAlive(molecule);
#endif
}
#else
bool findDrawn(out int molecule)
{
    molecule = gl_InstanceID;
    return isAlive(molecule);
}
#endif
