// Impacts in their order (docs/contact.md), in rounds of two passes before the other stages of the response. In this one each slot chooses
// the earliest impact that it may still have in this step, of which strike.pass.glsl lets those happen that both spheres have chosen. FIRST is
// the first choice of a step: with buffers two spheres that touch nothing else have their impact there, and all others that choose are
// listed for the rounds.
#ifdef FIRST
#pragma updates places sphereMotions impactRounds impactGroups
#pragma writes impacts impactSlots
const bool isFirst = true;
#else
const bool isFirst = false;
#endif
#pragma writes choices
#include "contact/response/impact.glsl"
#pragma reads impactRounds impactSlots impactGroups

// Whether the impact of a slot with one other comes before that with another; both happen.
bool isBefore(PairImpact a, PairImpact b, int slot, int otherOfA, int otherOfB)
{
    if (a.since != b.since) return a.since > b.since;
    if (a.speed != b.speed) return a.speed < b.speed;
    int own = sphereOf(slot);
    ivec2 others = ivec2(sphereOf(otherOfA), sphereOf(otherOfB));
    ivec2 first = min(ivec2(own), others);
    ivec2 second = max(ivec2(own), others);
    return first.x < first.y || (first.x == first.y && second.x < second.y);
}

// Returns the slot with which the own one has its earliest impact, and its entry, or NOBODY.
uvec2 choose(int slot)
{
    uvec2 choice = uvec2(NOBODY, 0u);
    PairImpact best = PairImpact(vec3(0.0), 0.0, 0.0, false);
    int listed = own.weight > 0.0 ? listedOf(slot) : 0;
    for (int e = 0; e < listed; ++e) {
        int other = int(listsAt(slot, e));
        Sphere sphere = sphereAt(other);
        PairImpact impact = impactOf(slot, other, sphere);
        bool isEarlier = impact.happens && (!best.happens || isBefore(impact, best, slot, other, int(choice.x)));
        while (isEarlier) {  // rare (contact/search/find.pass.glsl)
            loadMemory(slot);
            if (!haveMet(slot, other, sphere) && !isClosed(oldContact(other), areStruck(slot, other, sphere))) {
                choice = uvec2(other, e);
                best = impact;
            }
            isEarlier = false;
        }
    }
    return choice;
}

#ifdef TEXTURES
void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    loadSphere(slot);
    putChoices(slot, choose(slot));
#ifdef FIRST
    putAllImpacts(slot, uvec4[3](NO_IMPACT, uvec4(0u), uvec4(0u)));
#endif
}
#elif defined(FIRST)
#include "contact/response/strike.glsl"

// Two spheres that touch nothing else: the lower slot's lane has them both, and reads neither after it has struck it.
bool isPair(int slot, int other)
{
    return listedOf(slot) == 1 && listedOf(other) == 1 && sphereAt(other).weight > 0.0;
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    int other = int(listsAt(slot, 0));
    bool isPaired = listedOf(slot) > 0 && isPair(slot, other);
    if (isPaired && slot > other) return;
    loadSphere(slot);
    uvec2 choice = choose(slot);
    bool any = choice.x != NOBODY;
    if (isPaired && any) {
        strike(slot, other, sphereAt(other), 0u, 0u);
        return;
    }
    if (isPaired) putImpacts(other, 0, NO_IMPACT);
    putImpacts(slot, 0, NO_IMPACT);
    putChoices(slot, choice);
    putImpactRounds(slot, any ? 1u : 0u);
    if (any) listSlot(slot);
}
#else
uniform int roundNumber;  // from 1

void main()
{
    if (gl_GlobalInvocationID.x >= impactGroupsAt(0, 3)) return;
    int slot = int(impactSlotsAt(ownNumber()));
    if (impactRoundsAt(slot) != uint(roundNumber)) return;
    loadSphere(slot);
    putChoices(slot, choose(slot));
}
#endif
