// Spheres of contact (src/simulate/molecule_contact.h). A slot is a place in the order of their cells.
//
//   places   by slot: xyz local position as bits (physics/cells.glsl), w label: group * 2^26 + molecule
//   cells    by slot: xyz cell, w radius as bits
//   sorted   by slot: x key of its cell, y sphere
//   motions  by sphere: xyz velocity as bits, m/s; w 1/mass as bits, 0 where held
#include "physics/cells.glsl"

layout(local_size_x = 64) in;

uniform int count;     // spheres
uniform int keyMask;   // of the table of cells
uniform float cell;    // m
uniform usamplerBuffer places;
uniform usamplerBuffer sorted;
uniform usamplerBuffer motions;
uniform usamplerBuffer cells;

int sphereOf(int slot)
{
    return int(texelFetch(sorted, slot).y);
}
