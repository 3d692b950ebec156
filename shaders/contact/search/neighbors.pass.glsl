// UberFlow's search (section 4.4): the spheres up to NEIGHBORS places before and behind one in the order of the keys are candidates. Those
// of its own cell that lie further, and those of most cells around it, are missed. With a second grid, moved by half a cell (STAGGERED), its
// order adds to what the first has found.
#ifndef TEXTURES
#pragma updates counts lists
#endif
#include "contact/search/touch.glsl"

#ifdef TEXTURES
bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(entries[e >> 2][e & 3]) == slot;
    return known;
}
#else
bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(listsAt(searching, e)) == slot;
    return known;
}
#endif

void look(int slot)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int other = slot + k;
        if (k != 0 && other >= 0 && other < count && isCandidate(other)) meet(other);
    }
}

#ifdef STAGGERED
#pragma reads staggered slots

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
#endif

#ifdef TEXTURES
#ifdef STAGGERED
#include "contact/grid/staggered.glsl"
#include "sort/pairs.glsl"
#endif

void main()
{
    int slot = ownLane();
    for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
    loadOwn(slot);
    look(slot);
#ifdef STAGGERED
    uint key = staggeredKey(ownCell, ownPlace, cell, keyMask);
    lookStaggered(placeOfNumber(staggered, uint(sphereOf(slot)), placeOfKey(staggered, key, count), count));
#endif
    finish(slot);
}
#else
void main()
{
#ifdef SECOND_GRID
    if (isBehindLast()) return;
    int place = ownLane();
    int slot = int(slotsAt(int(staggeredAt(place).y)));
    loadOwn(slot);
    found = int(countsAt(slot) & CONTACTS);
    lookStaggered(place);
#else
    int slot = ownLane();
    loadOwn(slot);
    look(slot);
#endif
    if (!isBehindLast()) finish(slot);
}
#endif
