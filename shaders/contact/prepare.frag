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
    for (int i = 0; i < ENTRIES_A_DRAW / 2; ++i) {
        Entry known = Entry(vec4(0.0), vec4(0.0));
        if (firstEntry + i < listed) known = prepare(slot, entryOf(slot, firstEntry + i));
        newPushes[i] = known.push;
        newAnchors[i] = known.anchor;
    }
}
