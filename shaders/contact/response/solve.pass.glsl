// An iteration (contact/response/solve.glsl) but the first.
#pragma updates impulses earlierImpulses colliderImpulses earlierColliderImpulses
uniform float momentum;
#include "contact/response/iteration.glsl"
#pragma reads normals weights

Constraint constraintOf(int slot, int e)
{
    return constraintFrom(normalsAt(ownRow(slot), e), weightsAt(ownRow(slot), e));
}

#include "contact/response/solve.glsl"
