// The impulses with which contacts begin, in fragments, which work out some of them in a pass.
#include "contact/response/warm_start.glsl"
#pragma writes nextImpulses anchors

void main()
{
    int slot = ownSlot(count);
    int listed = listedOf(slot);
    if (listed <= firstEntry) discard;
    loadOld(slot);
    for (int i = 0; i < ENTRIES_A_DRAW; ++i) {
        int e = firstEntry + i;
        ContactImpulse known = noImpulse(IMPACT);
        Pair pair;
        if (e < listed) known = prepare(slot, int(listsAt(slot, e)), pair);
        putNextImpulses(slot, e, firstPart(known));
        putAnchors(slot, e, secondPart(known));
    }
    putEntries();
}
