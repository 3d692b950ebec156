// UberFlow's search in both grids, in fragments.
#include "contact/search/neighbors.glsl"
#include "contact/grid/staggered.glsl"
#include "sort/pairs.glsl"

void main()
{
    int slot = ownLane();
    beginList();
    loadOwn(slot);
    look(slot);
    uint key = staggeredKey(ownCell, ownPlace, cell, keyMask);
    lookStaggered(placeOfNumber(staggered, uint(sphereOf(slot)), placeOfKey(staggered, key, count), count));
    finish(slot);
}
