// order: a texel a slot: the records in the order of the keys, so that neighbours in space are read together.
#include "state/numbered.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform UINTS spherePlaces;
uniform UINTS sphereMotions;
uniform UINTS sphereCells;
uniform int count;

layout(location = 0) out uvec4 newPlace;
layout(location = 1) out uvec4 newMotion;
layout(location = 2) out uvec4 newCell;

void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    int sphere = int(pairAt(sorted, slot).y);
    newPlace = fetch(spherePlaces, sphere);
    newMotion = fetch(sphereMotions, sphere);
    newCell = fetch(sphereCells, sphere);
}
