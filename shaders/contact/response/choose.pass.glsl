// Impacts in their order (docs/contact.md), in rounds of two passes before the other stages of the response. In this one each slot chooses
// the earliest impact that it may still have in this step, of which strike.pass.glsl lets those happen that are the next of both molecules.
// FIRST is the first choice of a step: with buffers two spheres that touch nothing else, and move nothing else, have their impact there, and
// all others that choose are listed for the rounds.
#ifdef FIRST
#pragma updates impactRounds impactGroups
#pragma writes places sphereMotions when buffers
#pragma writes impacts impactSlots
const bool isFirst = true;
#else
#pragma updates impactGroups
const bool isFirst = false;
#endif
#pragma writes choices
#include "contact/response/choice.glsl"
#pragma reads impactRounds impactSlots

Choice choose(int slot)
{
    Choice best = noChoice;
    int listed = own.weight > 0.0 ? listedOf(slot) : 0;
    for (int e = 0; e < listed; ++e) {
        int other = int(listsAt(slot, e));
        Sphere sphere = sphereAt(other);
        PairImpact impact = impactOf(slot, other, sphere);
        Choice next = Choice(uint(other), uint(e), impact.since, impact.speed);
        bool isEarlier = isOne(impact, sphere) && (best.other == NOBODY || isBefore(slot, next, slot, best));
        while (isEarlier) {  // rare (contact/search/find.pass.glsl)
            loadMemory(slot);
            if (!haveMet(slot, other, sphere) && !isClosed(oldContact(other), areStruck(slot, other, sphere))) best = next;
            isEarlier = false;
        }
    }
    return best;
}

#ifdef TEXTURES
void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    loadSphere(slot);
    putChoices(slot, packedChoice(choose(slot)));
#ifdef FIRST
    putAllImpacts(slot, uvec4[3](NO_IMPACT, uvec4(0u), uvec4(0u)));
#endif
}
#elif defined(FIRST)
#include "contact/response/strike.glsl"

// Nothing is known of others' choices while they are made.
Choice choiceOf(int slot)
{
    return noChoice;
}

// Two spheres that neither touch nor move anything else: the lower slot's lane has them both, and reads neither after it has struck it.
bool isPair(int slot, int other)
{
    return !SPREADS && listedOf(slot) == 1 && listedOf(other) == 1 && sphereAt(other).weight > 0.0;
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    int other = int(listsAt(slot, 0));
    bool isPaired = listedOf(slot) > 0 && isPair(slot, other);
    if (isPaired && slot > other) return;
    loadSphere(slot);
    Choice choice = choose(slot);
    bool any = choice.other != NOBODY;
    if (isPaired && any) {
        strike(slot, choice);
        return;
    }
    if (isPaired) putImpacts(other, 0, NO_IMPACT);
    putImpacts(slot, 0, NO_IMPACT);
    putChoices(slot, packedChoice(choice));
    putImpactRounds(slot, any ? 1u : 0u);
    if (any) listSlot(slot);
}
#else
uniform int roundNumber;  // from 1

void main()
{
    uint listed = impactGroupsBuffer[4];
    if (gl_GlobalInvocationID.x == 0u) putImpactGroups(0, 3, listed);  // strike.pass.glsl lists more while it reads this
    if (gl_GlobalInvocationID.x >= listed) return;
    int slot = int(impactSlotsAt(ownNumber()));
    if (impactRoundsAt(slot) != uint(roundNumber)) return;
    loadSphere(slot);
    putChoices(slot, packedChoice(choose(slot)));
}
#endif
