// The constraints of some contacts, in fragments (contact/response/constraint.glsl).
#include "contact/response/constraint.glsl"
#pragma reads anchors
#pragma writes normals weights

void main()
{
    int slot = ownSlot(count);
    int listed = listedOf(slot);
    if (listed <= firstEntry) discard;
    loadSphere(slot);
    for (int i = 0; i < ENTRIES_A_DRAW; ++i) {
        int e = firstEntry + i;
        putNormals(slot, e, vec4(0.0));
        putWeights(slot, e, vec4(0.0));
        if (e < listed) {
            Constraint made = constrain(slot, int(listsAt(slot, e)), impulseFrom(vec4(0.0), anchorsAt(slot, e)));
            putNormals(slot, e, vec4(made.normal, made.target));
            putWeights(slot, e, vec4(made.weights, made.lacks, made.friction));
        }
    }
    putEntries();
}
