// The impulse with which a contact begins, from what it remembers of the last step.
#include "contact/response/pair.glsl"
#include "contact/response/memory.glsl"
#pragma reads oldLists oldImpulses oldAnchors oldWarmStart partners keptImpulses keptAnchors

int memory;  // of the own sphere
bool remembers;
int oldListed;

void loadOld(int slot)
{
    loadSphere(slot);
    memory = memoryOf(sphereOf(slot));
    remembers = !own.fresh && remembersAt(memory);
    oldListed = remembers ? listedIn(memoryCountAt(memory)) : 0;
}

int partnerAt(int e)
{
    return int(inTextures ? oldListsAt(memory, e) : partnersAt(memory, e));
}

ContactImpulse oldImpulse(int e)
{
    if (inTextures) return impulseFrom(oldImpulsesAt(memory, e), oldAnchorsAt(memory, e));
    return impulseFrom(keptImpulsesAt(memory, e), keptAnchorsAt(memory, e));
}

// Returns from what the iterations set out to push apart what the last step pushed by `before`, kg m: from most of it while it still
// overlaps, or the pressure of a pile would travel afresh in each step, one contact an iteration. From 0.9 of it a pile sways.
float carriedOver(float before, float depth)
{
    return depth > 0.0 ? 0.7 * before : 0.0;
}

// Returns a contact's impulse as the step begins with it. `pair`: as pairAs() has it.
ContactImpulse prepare(int slot, int other, out Pair pair)
{
    int otherMemory = memoryOf(sphereOf(other));
    int place = -1;
    for (int e = 0; e < oldListed; ++e) place = partnerAt(e) == otherMemory ? e : place;
    ContactImpulse old = oldImpulse(max(place, 0));
    bool isOld = place >= 0 && old.kind != NO_PART && !isFresh(other);
    // what is remembered is no impact, however fast it closes
    pair = pairOf(slot, other, isOld ? 1e30 : restSpeed);
    PairContact contact = pair.contact;
    float reach = own.radius + pair.sphere.radius;
    ContactImpulse known = noImpulse(contact.impact ? IMPACT : PERSISTENT);
    // a little along the normal as well, which is then known where centres coincide
    known.anchor = (contact.impact ? vec3(0.0) : pair.apart) + contact.normal * ((contact.impact ? 1.0 : 1e-6) * reach);
    if (contact.impact) return known;
    // what has not touched yet and comes fast will be an impact
    bool comes = !isOld && contact.depth <= 0.0 && contact.speed < -restSpeed;
    if (comes || !pair.meets) {
        known.kind = NO_PART;
        pair.meets = false;
        return known;
    }
    if (isOld) {
        known.impulse = remembered(old, pair.sphere).impulse;
        if ((old.kind == PERSISTENT && old.sticks) || isDeep(contact, reach)) known.anchor = old.anchor;
    }
    leaveAsCome(pair, known.anchor);
    if (isOld) known.multiplier = carriedOver(old.multiplier, pair.contact.depth);
    known.impulse = withinFriction(known.impulse, pair.contact.normal, pair.material.y);
    known.start = length(known.impulse);
    return known;
}
