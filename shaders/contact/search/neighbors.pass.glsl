// UberFlow's search (section 4.4): the spheres up to NEIGHBORS places before and behind one in the order of the keys are candidates. Those
// of its own cell that lie further, and those of most cells around it, are missed. With a second grid, moved by half a cell, its order adds to
// what the first has found.
#include "contact/search/touch.glsl"
#pragma reads staggered slots

// `place`: of the slot in the order of one of the grids.
void look(int place, bool inSecond)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int beside = place + k;
        if (k != 0 && beside >= 0 && beside < count) {
            int other = inSecond ? int(slotsAt(int(staggeredAt(beside).y))) : beside;
            if (isCandidate(other) && !(inSecond && isListed(other))) meet(other);
        }
    }
}

#if defined(SECOND_GRID) && defined(TEXTURES)
#include "sort/pairs.glsl"

void main()
{
    int slot = ownLane();
    loadOwn(slot);
    look(slot, false);
    uint key = staggeredKey(ownCell, ownPlace, cell, keyMask);
    look(placeOfNumber(staggered, uint(sphereOf(slot)), placeOfKey(staggered, key, count), count), true);
    finish(slot);
}
#elif defined(SECOND_GRID)
void main()
{
    int place = ownLane();
    int slot = int(slotsAt(int(staggeredAt(place).y)));
    loadOwn(slot);
    found = int(countsAt(slot) & CONTACTS);
    look(place, true);
    if (!isBehindLast()) finish(slot);
}
#else
void main()
{
    int slot = ownLane();
    loadOwn(slot);
    look(slot, false);
    if (!isBehindLast()) finish(slot);
}
#endif
