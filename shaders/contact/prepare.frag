// prepare: a texel a slot, contact/prepare.glsl, of some entries.
#include "contact/prepare.glsl"

uniform int firstEntry;

layout(location = 0) out vec4 newPushes[ENTRIES_A_DRAW / 2];
layout(location = 4) out vec4 newAnchors[ENTRIES_A_DRAW / 2];

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? listedOf(slot) : 0;
    if (listed <= firstEntry) discard;
    loadOld(slot);
    vec4 known[ENTRIES_A_DRAW / 2];
    vec4 place[ENTRIES_A_DRAW / 2];
    for (int i = 0; i < ENTRIES_A_DRAW / 2; ++i) {
        Entry one = Entry(vec4(0.0), vec4(0.0));
        Meeting with;
        if (firstEntry + i < listed) one = prepare(slot, entryOf(slot, firstEntry + i), with);
        known[i] = one.push;
        place[i] = one.anchor;
    }
    newPushes = known;
    newAnchors = place;
}
