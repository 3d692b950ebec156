// Which molecule is drawn at a place of a draw. Variants: ORDERED (not as they are numbered), SLABS (only those of one slab
// of depth), SLAB_DRAWS (the same, where each slab has a draw of its own).
#include "state/molecule.glsl"
#ifdef ORDERED
#include "render/order.glsl"

uniform int slab;
#ifdef SLABS
uniform usampler2D slabs;  // texel s: x the first key of slab s, y the first one past it
#endif
#ifdef SLAB_DRAWS
uniform usamplerBuffer slabDraws;  // src/render/draw_order.h
#endif
#endif

// `end`: one past the last place. False: not drawn now.
bool findDrawn(int place, int end, out int molecule)
{
#ifdef SLAB_DRAWS
    place += int(texelFetch(slabDraws, 8 * slab + 5).x);
    end = int(texelFetch(slabDraws, 8 * slab + 6).x);
#endif
    bool drawn = place < end;
    molecule = min(place, end - 1);
#ifdef ORDERED
    uvec2 pair = orderAt(molecule);
    molecule = int(pair.y);
#endif
#ifdef SLABS
    uvec2 bounds = texelFetch(slabs, ivec2(slab, 0), 0).xy;
    drawn = drawn && pair.x >= bounds.x && pair.x < bounds.y;
#endif
    return drawn && isAlive(molecule);
}
