// The list of a slot's contacts in fragments, which write it at their end.
#pragma writes counts dropped lists
#pragma reads oldDropped

uvec4 entries[LIST / 4];

void beginList()
{
    for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
}

int foundBefore(int slot)
{
    return 0;  // fragments search all grids at once
}

void take(int slot)
{
    entries[found >> 2][found & 3] = uint(slot);
}

bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(entries[e >> 2][e & 3]) == slot;
    return known;
}

void keep(int slot, uint counted)
{
    putCounts(slot, counted);
    putDropped(slot, oldDroppedAt(slot) + uint(max(found - LIST, 0)));
    newLists = entries;
}
