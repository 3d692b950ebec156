// The first iteration (contact/response/solve.glsl) with buffers, which also works out the constraints for all.
#pragma updates impulses earlierImpulses colliderImpulses earlierColliderImpulses
const float momentum = 0.0;
#include "contact/response/iteration.glsl"
#pragma reads anchors
#pragma updates normals weights

Constraint constraintOf(int slot, int e)
{
    int row = ownRow(slot);
    Constraint made = constrain(slot, int(listsAt(slot, e)), impulseFrom(vec4(0.0), anchorsAt(row, e)));
    putNormals(row, e, vec4(made.normal, made.target));
    putWeights(row, e, vec4(made.weights, made.lacks, made.friction));
    return made;
}

#include "contact/response/solve.glsl"
