// relax: a texel a slot, contact/relax.glsl, of some entries.
#include "contact/relax.glsl"

uniform int firstEntry;
uniform ENTRIES pushes;
uniform ENTRIES earlierPushes;
uniform ENTRIES normals;  // contact/constraint.glsl
uniform ENTRIES amounts;

layout(location = 0) out vec4 newPushes[ENTRIES_A_DRAW];

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? listedOf(slot) : 0;
    if (listed <= firstEntry) discard;
    loadOwn(slot);
    vec4 next[ENTRIES_A_DRAW];
    for (int i = 0; i < ENTRIES_A_DRAW; ++i) {
        int e = firstEntry + i;
        next[i] = vec4(0.0);
        if (e < listed)
            next[i] = relax(entryOf(slot, e), constraintOf(entry(normals, slot, e), entry(amounts, slot, e)), entry(pushes, slot, e),
                            entry(earlierPushes, slot, e));
    }
    newPushes = next;
}
