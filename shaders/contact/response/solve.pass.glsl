// The stage of contact/response/pair.glsl that is repeated: one Jacobi iteration of all impulses. With buffers what an iteration makes takes the
// place of `earlierImpulses`, which are `impulses` from then on, and the first (FIRST) works out the constraints for all. In fragments passes
// before it work out the constraints (FIRST) and then the impulses (ENTRIES), some in each; this one works out the colliders' and the
// sums.
//
// An entry of `earlierImpulses` is read as a texture, which a CPU rasteriser fetches faster than from a storage block: what takes its place is
// made of it, so that it comes later, and no other lane reads it.
#pragma updates colliderImpulses earlierColliderImpulses
#pragma reads impulses earlierImpulses
#pragma writes earlierImpulses earlierTotals when buffers
#ifdef FIRST
const float momentum = 0.0;
#pragma updates normals weights when buffers
#pragma writes normals weights partnerRows
#else
uniform float momentum;
#endif
#include "contact/response/iteration.glsl"
#pragma reads anchors

#ifdef FIRST
Constraint constraintOf(int slot, int e)
{
    int row = ownRow(slot);
    Constraint made = constrain(slot, int(listsAt(slot, e)), impulseFrom(vec4(0.0), anchorsAt(row, e)));
    putPartnerRows(row, e, uint(rowOfOther(slot, e)));
    putNormals(row, e, vec4(made.normal, made.target));
    putWeights(row, e, vec4(made.weights, made.lacks, made.friction));
    return made;
}
#endif

#ifdef ENTRIES
#ifndef FIRST
#pragma writes nextImpulses
#endif
#include "contact/response/entries.glsl"

void makeEntry(int slot, int e)
{
    Constraint asked = constraintOf(slot, e);
#ifndef FIRST
    putNextImpulses(slot, e, solve(rowOfOther(slot, e), asked, impulsesAt(slot, e), earlierImpulsesAt(slot, e)));
#endif
}
#else
#pragma reads warmStart rowSpheres
#pragma writes nextTotals nextVelocities nextColliderImpulses

uniform float nextMomentum;  // of the next iteration
#if !defined(FIRST) && !defined(TEXTURES)
#include "contact/response/batches.glsl"

uniform int batch;  // that ends with this iteration, or -1
uniform float tolerance;
float residual = 0.0;  // of the own contacts

void addResidual(Constraint asked, vec4 next, vec4 push, vec4 before)
{
    if (batch >= 0) residual = max(residual, residualOf(asked, next, push, before));
}

void endBatch()
{
    uint bits = floatBitsToUint(residual);
    bool isLarger = batch >= 0 && bits > batches[batch].residual;
    while (isLarger) {  // a loop, which a CPU rasteriser leaves where no lane stays (contact/search/find.pass.glsl)
        atomicMax(batches[batch].residual, bits);
        if (residual > tolerance && batch + 1 < batches.length()) batches[batch + 1].groupsX = batches[0].groupsX;
        isLarger = false;
    }
}
#else
void addResidual(Constraint asked, vec4 next, vec4 push, vec4 before)
{
}

void endBatch()
{
}
#endif

// Returns the first part of a contact's impulse after the iteration.
vec4 solveEntry(int slot, int e, Constraint asked)
{
    int row = ownRow(slot);
    if (inTextures) return impulsesAt(row, e);
    vec4 push = impulsesAt(row, e);
    vec4 before = earlierImpulsesAt(row, e);
    vec4 next = solve(rowOfOther(slot, e), asked, push, before);
    addResidual(asked, next, push, before);
    putEarlierImpulses(row, e, next);  // these are the next from now on
    return next;
}

// Returns a collider's impulse after the iteration.
vec4 solveCollider(NearCollider near, vec4 push, vec4 before)
{
    if (ownCount <= 0.0 || bouncesNext(near)) return vec4(0.0);
    Constraint asked = constrainCollider(near);
    ContactImpulse next = solved(asked, Moved(near.velocity, vec3(0.0)), push, before);
    vec4 impulse = vec4(next.impulse, next.multiplier);
    addResidual(asked, impulse, push, before);
    return impulse;
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    loadOwn(slot);
    int row = ownRow(slot);
    int listed = listedOf(slot);
    vec3 impulse = -(inTextures ? warmStartAt(row) : rowSpheresAt(row, 1)).xyz;
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        Constraint asked = constraintOf(slot, e);
        vec4 push = solveEntry(slot, e, asked);
        impulse += push.xyz;
        shift += asked.normal * abs(push.w);
    }
    if (COLLIDERS) {
        int memory = memoryRow(slot);
        vec4 next[MOST_COLLIDERS];
        for (int k = 0; k < MOST_COLLIDERS; ++k) next[k] = vec4(0.0);
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            NearCollider near = colliderNear(sphereOf(slot), k);
            if (!isNear(near) || own.weight <= 0.0) break;
            vec4 push = colliderImpulsesAt(memory, k);
            next[k] = solveCollider(near, push, earlierColliderImpulsesAt(memory, k));
            impulse += next[k].xyz;
            shift += near.normal * next[k].w;
            putEarlierColliderImpulses(memory, k, push);
            putColliderImpulses(memory, k, next[k]);
        }
        putAllNextColliderImpulses(slot, next);
    }
    vec4 next[2] = vec4[2](vec4(impulse, totalsAt(row, 0).w), vec4(shift, 0.0));
    putAllNextTotals(row, next);
    putAllEarlierTotals(row, next);  // with buffers these are the next from now on
    vec3 further = impulse + (impulse - totalsAt(row, 0).xyz) * nextMomentum;
    putNextVelocities(row, 0, vec4(own.velocity + further * own.weight, 0.0));
    further = shift + (shift - totalsAt(row, 1).xyz) * nextMomentum;
    putNextVelocities(row, 1, vec4(further * own.weight, 0.0));
    endBatch();
}
#endif
