// Spheres of contact (src/simulate/molecule_contact.h). A slot is a place in the order of their cells.
//
//   places   by slot: xyz local position as bits (physics/cells.glsl), w label: group * 2^26 + molecule
//   sorted   by slot: y its sphere
//   cells    by slot: xyz cell, w radius as bits, and RESTS
//   motions  by sphere, or with TEXTURES by slot: xyz velocity as bits, m/s; w 1/mass as bits, 0 where held, and FRESH
#include "state/numbered.glsl"
#include "physics/cells.glsl"
#include "contact/flags.glsl"

uniform int count;     // spheres
uniform int keyMask;   // of the table of cells
uniform float cell;    // m
uniform UINTS places;
uniform UINTS motions;
uniform UINTS cells;

#ifdef TEXTURES
#include "sort/pairs.glsl"

uniform usampler2D sorted;

int sphereOf(int slot)
{
    return int(pairAt(sorted, slot).y);
}

// Where the motion of a slot is.
int motionOf(int slot)
{
    return slot;
}
#else
layout(local_size_x = 64) in;

uniform usamplerBuffer sorted;

int sphereOf(int slot)
{
    return int(texelFetch(sorted, slot).y);
}

int motionOf(int slot)
{
    return sphereOf(slot);
}
#endif

// Whether the molecule of a slot's sphere rested when the step began.
bool rested(int slot)
{
    return (fetch(cells, slot).w & RESTS) != 0u;
}
