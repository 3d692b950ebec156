// An iteration (contact/response/solve.glsl) of some impulses of each list, in fragments; another pass has the colliders' and the sums.
uniform float momentum;
#include "contact/response/iteration.glsl"
#pragma reads normals weights
#pragma writes nextImpulses

void main()
{
    int slot = ownSlot(count);
    int listed = listedOf(slot);
    if (listed <= firstEntry) discard;
    loadOwn(slot);
    for (int i = 0; i < ENTRIES_A_DRAW; ++i) {
        int e = firstEntry + i;
        vec4 next = vec4(0.0);
        if (e < listed)
            next = solve(int(listsAt(slot, e)), constraintFrom(normalsAt(slot, e), weightsAt(slot, e)), impulsesAt(slot, e),
                         earlierImpulsesAt(slot, e));
        putNextImpulses(slot, e, next);
    }
    putEntries();
}
