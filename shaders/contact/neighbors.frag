// neighbors: UberFlow's search (section 4.4), of the spheres that a slot touches those among its neighbours in the order of
// the keys, and with STAGGERED in that of a second grid, moved by half a cell.
#include "contact/records.glsl"
#include "contact/touch.glsl"

#ifdef STAGGERED
#include "contact/staggered.glsl"

uniform usampler2D staggered;
uniform UINTS slots;  // of a sphere

bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(entries[e >> 2][e & 3]) == slot;
    return known;
}

void searchStaggered(int slot)
{
    uint sphere = uint(sphereOf(slot));
    uint key = staggeredKey(ownCell, ownPlace, cell, keyMask);
    int place = placeOfNumber(staggered, sphere, placeOfKey(staggered, key, count), count);
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int at = place + k;
        if (k != 0 && at >= 0 && at < count) {
            int other = int(fetch(slots, int(pairAt(staggered, at).y)).x);
            if (isCandidate(other) && !isListed(other)) meet(other);
        }
    }
}
#endif

void search(int slot)
{
    loadOwn(slot);
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int other = slot + k;
        if (k != 0 && other >= 0 && other < count && isCandidate(other)) meet(other);
    }
#ifdef STAGGERED
    searchStaggered(slot);
#endif
}

#include "contact/found.glsl"
