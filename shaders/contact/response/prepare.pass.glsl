// The first stage of contact/response/pair.glsl: the impulse with which each contact begins, from what it remembers of the last step (warm
// start), and the sums of all. In fragments a pass works out some impulses (ENTRIES), and another the sums.
#ifndef TEXTURES
#pragma updates warmStart
#endif
#ifdef WALLS
#pragma updates colliderImpulses
#endif
#include "contact/response/warm_start.glsl"

#ifdef ENTRIES
#pragma writes nextImpulses anchors

void main()
{
    int slot = ownSlot(count);
    int listed = listedOf(slot);
    if (listed <= firstEntry) discard;
    loadOld(slot);
    for (int i = 0; i < ENTRIES_A_DRAW; ++i) {
        int e = firstEntry + i;
        ContactImpulse known = noImpulse(IMPACT);
        Pair pair;
        if (e < listed) known = prepare(slot, int(listsAt(slot, e)), pair);
        putNextImpulses(slot, e, firstPart(known));
        putAnchors(slot, e, secondPart(known));
    }
    putEntries();
}
#else
#ifdef TEXTURES
#pragma reads impulses anchors
#pragma writes totals warmStart

// Returns the impulse that the pass before has begun.
ContactImpulse begin(int slot, int e, out Pair pair)
{
    ContactImpulse known = impulseFrom(impulsesAt(slot, e), anchorsAt(slot, e));
    pair = pairAs(slot, int(listsAt(slot, e)), known);
    return known;
}
#else
#pragma writes totals impulses anchors

ContactImpulse begin(int slot, int e, out Pair pair)
{
    ContactImpulse known = prepare(slot, int(listsAt(slot, e)), pair);
    putImpulses(ownRow(slot), e, firstPart(known));
    putAnchors(ownRow(slot), e, secondPart(known));
    return known;
}
#endif
#ifdef SPREAD
#pragma writes contactSums
#elif defined(TEXTURES)
#pragma writes effectiveCounts
#else
#pragma writes effectiveCounts velocities
#endif

// The contacts of the sphere, as they act on it together (physics/pair.glsl).
ContactSum contacts = ContactSum(vec3(0.0), vec3(0.0), 0.0);

void countIn(vec3 normal)
{
    contacts = withContact(contacts, normal, own.weight / max(ownWeights(normal), vec2(1e-30)));
}

#ifdef WALLS
#include "contact/response/colliders.glsl"
#pragma writes nextColliderImpulses
#ifdef TEXTURES
#pragma reads oldColliders

vec3 oldNormal(int slot, int k)
{
    return oldCollidersAt(sphereOf(slot), 2 * k).xyz;
}

// Returns what the last step has left of a collider's impulse. `part`: of all of them, how much is remembered.
vec4 oldColliderImpulse(int slot, int k, float part)
{
    return colliderImpulsesAt(memory, k) * vec4(vec3(part), 1.0);
}
#else
#pragma reads oldNormals

vec3 oldNormal(int slot, int k)
{
    return oldNormalsAt(sphereOf(slot), k).xyz;
}

vec4 oldColliderImpulse(int slot, int k, float part)
{
    return colliderImpulsesAt(memory, k);
}
#endif

struct ColliderImpulse {
    vec4 push;  // xyz impulse, N s; w how far it pushes the sphere off, kg m
    vec3 normal;
};

// Returns a collider's impulse as the step begins with it: that of the one in the last step whose normal was nearly the same.
// A sphere that touches nothing else has its collider answered by its own step.
vec4 prepareCollider(int slot, NearCollider near, ColliderImpulse old[MOST_COLLIDERS])
{
    vec4 push = vec4(0.0);
    if (!pressesOn(near) || !isActedOn(countsAt(slot))) return push;
    countIn(near.normal);
    for (int o = 0; o < MOST_COLLIDERS; ++o) {
        bool same = remembers && dot(old[o].normal, near.normal) > 0.9;
        vec4 kept = vec4(withinFriction(old[o].push.xyz, near.normal, near.friction), carriedOver(abs(old[o].push.w), -near.gap));
        push = same ? kept : push;
    }
    return push;
}
#endif

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    loadOld(slot);
    int listed = listedOf(slot);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        Pair pair;
        ContactImpulse known = begin(slot, e, pair);
        if (pair.meets) countIn(pair.contact.normal);
        impulse += known.impulse;
        shift += pair.contact.normal * known.multiplier;
    }
#ifdef TEXTURES
    vec4 acted = remembers ? oldWarmStartAt(memory) : vec4(0.0);
#else
    vec4 acted = remembers ? warmStartAt(memory) : vec4(0.0);
#endif
    float start = 0.0;  // of all that colliders push
#ifdef WALLS
    ColliderImpulse old[MOST_COLLIDERS];
    for (int k = 0; k < MOST_COLLIDERS; ++k) old[k] = ColliderImpulse(oldColliderImpulse(slot, k, acted.w), oldNormal(slot, k));
    vec4 pushes[MOST_COLLIDERS];
    for (int k = 0; k < MOST_COLLIDERS; ++k) {
        NearCollider near = colliderOf(slot, k);
        pushes[k] = prepareCollider(slot, near, old);
        impulse += pushes[k].xyz;
        shift += near.normal * pushes[k].w;
        start += length(pushes[k].xyz);
    }
    putAllNextColliderImpulses(slot, pushes);
    putAllColliderImpulses(memory, pushes);
#endif
    impulse -= acted.xyz;
#ifdef TEXTURES
    putWarmStart(slot, vec4(acted.xyz, 0.0));
#else
    if (!remembers) putWarmStart(memory, vec4(0.0));
#endif
    putTotals(slot, 0, vec4(impulse, start));
    putTotals(slot, 1, vec4(shift, 0.0));
#ifdef SPREAD
    putContactSums(slot, 0, vec4(contacts.diagonal, contacts.number));
    putContactSums(slot, 1, vec4(contacts.beside, 0.0));
#else
    putEffectiveCounts(slot, floatBitsToUint(listed > 0 ? effectiveCount(contacts) : 0.0));
#ifndef TEXTURES
    putVelocities(slot, 0, vec4(own.velocity + impulse * own.weight, 0.0));
    putVelocities(slot, 1, vec4(shift * own.weight, 0.0));
#endif
#endif
}
#endif
