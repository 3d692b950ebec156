// constrain: a texel a slot, contact/constrain.glsl, of some entries.
#include "contact/constrain.glsl"

uniform int firstEntry;
uniform ENTRIES anchors;

layout(location = 0) out vec4 normals[ENTRIES_A_DRAW / 2];
layout(location = 4) out vec4 amounts[ENTRIES_A_DRAW / 2];

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? listedOf(slot) : 0;
    if (listed <= firstEntry) discard;
    loadSphere(slot);
    vec4 ofNormals[ENTRIES_A_DRAW / 2];
    vec4 ofAmounts[ENTRIES_A_DRAW / 2];
    for (int i = 0; i < ENTRIES_A_DRAW / 2; ++i) {
        int e = firstEntry + i;
        vec4 one[2] = vec4[2](vec4(0.0), vec4(0.0));
        if (e < listed) one = texelsOf(constrain(slot, entryOf(slot, e), entry(anchors, slot, e)));
        ofNormals[i] = one[0];
        ofAmounts[i] = one[1];
    }
    normals = ofNormals;
    amounts = ofAmounts;
}
