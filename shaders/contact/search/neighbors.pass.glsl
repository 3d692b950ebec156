// UberFlow's search (section 4.4): the spheres up to NEIGHBORS places before and behind one in the order of the keys are candidates. Those
// of its own cell that lie further, and those of most cells around it, are missed. With a second grid, moved by half a cell, its order adds to
// what the first has found.
#include "contact/search/touch.glsl"
#pragma reads staggered slots

void look(int slot)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int other = slot + k;
        if (k != 0 && other >= 0 && other < count && isCandidate(other)) meet(other);
    }
}

// `place`: of the slot in the second grid.
void lookStaggered(int place)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int beside = place + k;
        if (k != 0 && beside >= 0 && beside < count) {
            int other = int(slotsAt(int(staggeredAt(beside).y)));
            if (isCandidate(other) && !isListed(other)) meet(other);
        }
    }
}

#if defined(SECOND_GRID) && defined(TEXTURES)
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
#elif defined(SECOND_GRID)
void main()
{
    int place = ownLane();
    int slot = int(slotsAt(int(staggeredAt(place).y)));
    loadOwn(slot);
    found = foundBefore(slot);
    lookStaggered(place);
    if (!isBehindLast()) finish(slot);
}
#else
void main()
{
    int slot = ownLane();
    beginList();
    loadOwn(slot);
    look(slot);
    if (!isBehindLast()) finish(slot);
}
#endif
