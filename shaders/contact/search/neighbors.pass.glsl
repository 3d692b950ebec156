// UberFlow's search in one grid: the first or, with buffers and SECOND_GRID, the second.
#include "contact/search/neighbors.glsl"

void main()
{
    int place = ownLane();
    int slot = SECOND_GRID ? int(slotsAt(int(staggeredAt(place).y))) : place;
    beginList();
    loadOwn(slot);
    if (SECOND_GRID) {
        found = foundBefore(slot);
        lookStaggered(place);
    } else {
        look(slot);
    }
    if (!isBehindLast()) finish(slot);
}
