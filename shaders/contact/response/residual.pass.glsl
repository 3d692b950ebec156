// In fragments, the residual of the contacts of each slot behind a batch of iterations (contact/response/batches.glsl), from the impulses of the
// last three.
uniform float momentum;
#include "contact/response/iteration.glsl"
#pragma reads nextImpulses colliderImpulses earlierColliderImpulses nextColliderImpulses
#pragma writes residuals

float residualAt(int slot)
{
    loadOwn(slot);
    float most = 0.0;
    int listed = listedOf(slot);
    for (int e = 0; e < listed; ++e)
        most = max(most, residualOf(constraintOf(slot, e), impulsesAt(slot, e), earlierImpulsesAt(slot, e), nextImpulsesAt(slot, e)));
    if (!COLLIDERS || ownCount <= 0.0) return most;
    for (int k = 0; k < MOST_COLLIDERS; ++k) {
        NearCollider near = colliderNear(sphereOf(slot), k);
        if (!isNear(near) || own.weight <= 0.0) break;
        if (bouncesNext(near)) continue;
        most = max(most, residualOf(constrainCollider(near), colliderImpulsesAt(slot, k), earlierColliderImpulsesAt(slot, k),
                                  nextColliderImpulsesAt(slot, k)));
    }
    return most;
}

void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    putResiduals(slot, countsAt(slot) == 0u ? 0u : floatBitsToUint(residualAt(slot)));
}
