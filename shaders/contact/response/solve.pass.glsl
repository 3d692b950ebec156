// The stage of contact/response/pair.glsl that is repeated: one Jacobi iteration of all impulses. With buffers what an iteration makes takes the
// place of `earlierImpulses`, which are `impulses` from then on, and the first (FIRST) works out the constraints for all. In fragments passes
// before it work out the constraints (FIRST) and then the impulses (ENTRIES), some in each; this one works out the colliders' and the
// sums.
#if defined(FIRST) && defined(TEXTURES)
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
#elif defined(ENTRIES)
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
#else
#pragma updates impulses earlierImpulses colliderImpulses earlierColliderImpulses
#ifdef FIRST
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
#else
uniform float momentum;
#include "contact/response/iteration.glsl"
#pragma reads normals weights

// The constraint of a contact.
Constraint constraintOf(int slot, int e)
{
    return constraintFrom(normalsAt(ownRow(slot), e), weightsAt(ownRow(slot), e));
}
#endif
#include "contact/grid/colliders.glsl"
#pragma reads warmStart
#pragma writes nextTotals nextVelocities nextColliderImpulses

uniform float nextMomentum;  // of the next iteration

// Returns the first part of a contact's impulse after the iteration, and its normal.
vec4 solveEntry(int slot, int e, out vec3 normal)
{
    int row = ownRow(slot);
    if (inTextures) {
        normal = normalsAt(row, e).xyz;
        return impulsesAt(row, e);
    }
    Constraint asked = constraintOf(slot, e);
    normal = asked.normal;
    vec4 next = solve(int(listsAt(slot, e)), asked, impulsesAt(row, e), earlierImpulsesAt(row, e));
    putEarlierImpulses(row, e, next);  // these are the next from now on
    return next;
}

// Returns a collider's impulse after the iteration: a body of infinite mass, which does not ask whether it slides.
vec4 solveCollider(NearCollider near, vec4 push, vec4 before)
{
    if (ownCount <= 0.0) return vec4(0.0);
    vec2 weights = stepWeights(weightsOf(own, ownBody, near.normal) * ownCount, ownCount);
    Constraint asked = Constraint(near.normal, partingSpeed(-near.gap, own.radius), weights, lacking(-near.gap, own.radius),
                                  near.friction);
    Push next = solved(asked, Moved(near.velocity, vec3(0.0)), push, before);
    return vec4(next.impulse, next.apart);
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    loadOwn(slot);
    int listed = listedOf(slot);
    vec3 impulse = -warmStartAt(memoryRow(slot)).xyz;
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        vec3 normal;
        vec4 push = solveEntry(slot, e, normal);
        impulse += push.xyz;
        shift += normal * abs(push.w);
    }
    if (COLLIDERS) {
        int row = memoryRow(slot);
        vec4 next[MOST_COLLIDERS];
        for (int k = 0; k < MOST_COLLIDERS; ++k) next[k] = vec4(0.0);
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            NearCollider near = colliderNear(sphereOf(slot), k);
            if (!isNear(near) || own.weight <= 0.0) break;
            vec4 push = colliderImpulsesAt(row, k);
            next[k] = solveCollider(near, push, earlierColliderImpulsesAt(row, k));
            impulse += next[k].xyz;
            shift += near.normal * next[k].w;
            putEarlierColliderImpulses(row, k, push);
            putColliderImpulses(row, k, next[k]);
        }
        putAllNextColliderImpulses(slot, next);
    }
    putNextTotals(slot, 0, vec4(impulse, totalsAt(slot, 0).w));
    putNextTotals(slot, 1, vec4(shift, 0.0));
    vec3 further = impulse + (impulse - totalsAt(slot, 0).xyz) * nextMomentum;
    putNextVelocities(slot, 0, vec4(own.velocity + further * own.weight, 0.0));
    further = shift + (shift - totalsAt(slot, 1).xyz) * nextMomentum;
    putNextVelocities(slot, 1, vec4(further * own.weight, 0.0));
}
#endif
