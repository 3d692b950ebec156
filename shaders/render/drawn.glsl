// Which molecule is drawn at a place of a draw: as they are numbered; in an order (ORDERED) and, where SLABS is true, of that
// only one slab of depth; or where each slab has a draw of its own (SLAB_DRAWS).
#include "state/molecule.glsl"

// Each takes one past the last place as `end`, and returns whether the molecule is drawn now.
#ifdef SLAB_DRAWS
#include "render/order.glsl"

uniform int slab;
uniform usamplerBuffer slabDraws;  // src/render/draw_order.h

bool findDrawn(int place, int end, out int molecule)
{
    place += int(texelFetch(slabDraws, 8 * slab + 5).x);
    end = int(texelFetch(slabDraws, 8 * slab + 6).x);
    molecule = int(orderAt(min(place, end - 1)).y);
    return place < end && isAlive(molecule);
}
#elif defined(ORDERED)
#include "render/order.glsl"

uniform int slab;
uniform usampler2D slabs;  // texel s: x the first key of slab s, y the first one past it

bool findDrawn(int place, int end, out int molecule)
{
    uvec2 pair = orderAt(min(place, end - 1));
    molecule = int(pair.y);
    bool drawn = place < end;
    if (SLABS) {
        uvec2 bounds = texelFetch(slabs, ivec2(slab, 0), 0).xy;
        drawn = drawn && pair.x >= bounds.x && pair.x < bounds.y;
    }
    return drawn && isAlive(molecule);
}
#else
bool findDrawn(int place, int end, out int molecule)
{
    molecule = min(place, end - 1);
    return place < end && isAlive(molecule);
}
#endif
