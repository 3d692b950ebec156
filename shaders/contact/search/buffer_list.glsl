// The list of a slot's contacts with buffers.
#include "contact/search/respond.glsl"
#pragma updates counts lists

layout(std430) buffer Dropped { uint dropped; };  // contacts that no list had room for, so far

uniform bool last;  // no other search adds to what this one lists

void beginList()
{
}

// Of another search.
int foundBefore(int slot)
{
    return int(countsAt(slot) & CONTACTS);
}

void take(int slot)
{
    putLists(searching, found, uint(slot));
}

bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(listsAt(searching, e)) == slot;
    return known;
}

void keep(int slot, uint counted)
{
    putCounts(slot, counted);
    bool takes = last && counted > 0u;
    while (takes) {
        addResponding(slot);
        if (found > LIST) atomicAdd(dropped, uint(found - LIST));
        takes = false;
    }
}
