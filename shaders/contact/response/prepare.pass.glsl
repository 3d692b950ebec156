// The first stage of contact/response/pair.glsl: the impulse with which each contact begins, from what it remembers of the last step (warm
// start), and the sums of all. In fragments passes before it work out the impulses, some in each (ENTRIES).
#ifdef ENTRIES
#pragma writes nextImpulses anchors
#else
#pragma updates impulses anchors colliderImpulses
#pragma reads warmStart
#pragma writes totals warmStart contactSums nextColliderImpulses
#pragma writes effectiveCounts when !spreads
#pragma writes velocities when buffers !spreads
#pragma writes rowSpheres
#endif
#include "contact/response/known.glsl"
#include "contact/response/hits.glsl"
#pragma reads oldWarmStart

void loadOwn(int slot)
{
    loadSphere(slot);
    loadMemory(slot);
}

// Returns from what the iterations set out to push apart what the last step pushed by `before`, kg m: from most of it while it still
// overlaps, or the pressure of a pile would travel afresh in each step, one contact an iteration. From 0.9 of it a pile sways.
float carriedOver(float before, float depth)
{
    return depth > 0.0 ? 0.7 * before : 0.0;
}

// Whether an impact was left over by the rounds (contact/response/choose.pass.glsl), or is to come. What would bounce too little for
// an impact is answered like what rests.
bool waits(Pair pair, ContactImpulse old, bool struck)
{
    float speed = -pair.contact.speed;
    if (isClosed(old, struck) || speed <= restSpeed) return false;
    return pair.contact.depth <= 0.0 || speed * pair.material.x > restSpeed;
}

// Returns an anchor that is dragged along by what has slipped further than `restingOverlap`: if it were drawn back all that way
// (contact/response/store.pass.glsl), what has stopped would not come to rest.
vec3 dragged(vec3 anchor, Pair pair, float reach)
{
    vec3 n = pair.contact.normal;
    vec3 slip = pair.apart - anchor;
    slip -= n * dot(slip, n);
    return anchor + slip * max(0.0, 1.0 - restingOverlap * reach / max(length(slip), 1e-30));
}

// Returns a contact's impulse as the step begins with it. `pair`: as pairAs() has it.
ContactImpulse prepare(int slot, int e, out Pair pair)
{
    int other = int(listsAt(slot, e));
    ContactImpulse old = oldContact(other);
    bool isOld = old.kind != NO_PART;
    pair = pairOf(slot, other);
    pair.meets = own.weight + pair.sphere.weight > 0.0 && (pair.sphere.rests || holds(other, slot));
    PairContact contact = pair.contact;
    float reach = own.radius + pair.sphere.radius;
    bool hadImpact = isStruck(slot) && hasHit(slot, e);
    bool again = old.kind == IMPACT || old.kind == REPEATED;
    ContactImpulse known = noImpulse(!hadImpact ? PERSISTENT : again ? REPEATED : IMPACT);
    // a little along the normal as well, which is then known where centres coincide
    known.anchor = pair.apart + contact.normal * (1e-6 * reach);
    if (!pair.meets || waits(pair, old, isStruck(slot) || (pair.sphere.weight > 0.0 && isStruck(other)))) {
        known.kind = NO_PART;
        pair.meets = false;
        return known;
    }
    if (isOld) {
        known.impulse = remembered(old, pair.sphere).impulse;
        if (isDeep(contact, reach))
            known.anchor = old.anchor;
        else if (old.kind == PERSISTENT && old.sticks)
            known.anchor = dragged(old.anchor, pair, reach);
    }
    leaveAsCome(pair, known.anchor);
    if (isOld && !hasWoken(slot) && !hasWoken(other)) known.multiplier = carriedOver(old.multiplier, pair.contact.depth);
    known.impulse = withinFriction(known.impulse, pair.contact.normal, pair.material.y);
    known.start = length(known.impulse);
    return known;
}

#ifdef ENTRIES
#include "contact/response/entries.glsl"

void makeEntry(int slot, int e)
{
    Pair pair;
    ContactImpulse known = prepare(slot, e, pair);
    putNextImpulses(slot, e, firstPart(known));
    putAnchors(slot, e, secondPart(known));
}
#else
#include "contact/grid/colliders.glsl"
#pragma reads oldColliders oldNormals

ContactImpulse begin(int slot, int e, out Pair pair)
{
    int row = ownRow(slot);
    if (inTextures) {
        ContactImpulse begun = impulseFrom(impulsesAt(row, e), anchorsAt(row, e));
        pair = pairAs(slot, int(listsAt(slot, e)), begun);
        return begun;
    }
    ContactImpulse known = prepare(slot, e, pair);
    putImpulses(row, e, firstPart(known));
    putAnchors(row, e, secondPart(known));
    return known;
}

// The contacts of the sphere, as they act on it together (physics/pair.glsl).
ContactSum contacts = ContactSum(vec3(0.0), vec3(0.0), 0.0);

void countIn(vec3 normal)
{
    contacts = withContact(contacts, normal, own.weight / max(weightsOf(own, ownBody, normal), vec2(1e-30)));
}

// Of a collider, in the last step.
struct ColliderImpulse {
    vec4 push;  // xyz impulse, N s; w how far it pushes the sphere off, kg m
    vec3 normal;
};

// Returns a collider's impulse as the step begins with it: that of the one in the last step whose normal was nearly the same.
// A sphere that touches nothing else has its collider answered by its own step.
vec4 prepareCollider(int slot, NearCollider near, ColliderImpulse old[MOST_COLLIDERS])
{
    vec4 push = vec4(0.0);
    if (!isNear(near) || bouncesNext(near) || own.weight <= 0.0 || !isActedOn(countsAt(slot))) return push;
    countIn(near.normal);
    for (int o = 0; o < MOST_COLLIDERS; ++o) {
        bool same = remembers && dot(old[o].normal, near.normal) > 0.9;
        vec4 kept = vec4(withinFriction(old[o].push.xyz, near.normal, near.friction), carriedOver(abs(old[o].push.w), -near.gap));
        push = same ? kept : push;
    }
    return push;
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    loadOwn(slot);
    int row = ownRow(slot);
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
    vec4 acted = vec4(0.0);
    if (remembers) acted = inTextures ? oldWarmStartAt(memory) : warmStartAt(memory);
    float start = 0.0;  // of all that colliders push
    if (COLLIDERS) {
        vec4 part = inTextures ? vec4(vec3(acted.w), 1.0) : vec4(1.0);  // of what they pushed, how much is remembered
        ColliderImpulse old[MOST_COLLIDERS];
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            vec4 normal = inTextures ? oldCollidersAt(sphereOf(slot), 2 * k) : oldNormalsAt(memory, k);
            old[k] = ColliderImpulse(colliderImpulsesAt(memory, k) * part, normal.xyz);
        }
        vec4 pushes[MOST_COLLIDERS];
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            NearCollider near = colliderNear(sphereOf(slot), k);
            pushes[k] = prepareCollider(slot, near, old);
            impulse += pushes[k].xyz;
            shift += near.normal * pushes[k].w;
            start += length(pushes[k].xyz);
        }
        putAllNextColliderImpulses(slot, pushes);
        putAllColliderImpulses(memory, pushes);
    }
    impulse -= acted.xyz;
    if (inTextures || !remembers) putWarmStart(memoryRow(slot), vec4(acted.xyz, 0.0));
    putTotals(row, 0, vec4(impulse, start));
    putTotals(row, 1, vec4(shift, 0.0));
    putRowSpheres(row, 0, vec4(own.velocity, own.weight));
    putRowSpheres(row, 1, vec4(acted.xyz, own.radius));
    putContactSums(slot, 0, vec4(contacts.diagonal, contacts.number));
    putContactSums(slot, 1, vec4(contacts.beside, 0.0));
    putEffectiveCounts(slot, floatBitsToUint(listed > 0 ? effectiveCount(contacts) : 0.0));
    putVelocities(row, 0, vec4(own.velocity + impulse * own.weight, 0.0));
    putVelocities(row, 1, vec4(shift * own.weight, 0.0));
}
#endif
