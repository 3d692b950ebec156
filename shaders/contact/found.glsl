// A texel a slot: the list of the spheres that search() finds (contact/touch.glsl).
#ifndef REMEMBERS
uniform UINTS oldCounts;
#endif

layout(location = 0) out uvec4 newCounts;  // x contacts; y those left out so far, summed over all that have had this slot
layout(location = 1) out uvec4 newLists[LIST / 4];

void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
    search(slot);
    uint before = fetch(oldCounts, slot).y;
    newCounts = uvec4(countFound(slot), before + uint(max(found - LIST, 0)), 0u, 0u);
    newLists = entries;
}
