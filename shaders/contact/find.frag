// find: a texel a slot: the list of the spheres that it touches. All of them, or UberFlow's search (section 4.4):
//   NEAR        those among its neighbours in the order of the keys
//   STAGGERED   and in that of a second grid, moved by half a cell
#include "contact/records.glsl"
#include "contact/touch.glsl"

#ifdef NEAR
#ifdef STAGGERED
#include "contact/pairs.glsl"
#include "contact/staggered.glsl"

uniform usampler2D sorted;
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
    uint sphere = pairAt(sorted, slot).y;
    uint key = staggeredKey(ownCell, ownPlace, cell, keyMask);
    int place = placeOfSphere(staggered, sphere, placeOfKey(staggered, key, count), count);
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
#else
#include "contact/search.glsl"
#endif

uniform UINTS oldCounts;

layout(location = 0) out uvec4 newCounts;  // x contacts; y those left out so far, of whatever had this slot
layout(location = 1) out uvec4 newLists[LIST / 4];

void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
    search(slot);
    uint before = fetch(oldCounts, slot).y;
    newCounts = uvec4(uint(found), before + uint(max(found - LIST, 0)), 0u, 0u);
    newLists = entries;
}
