// Lets those impacts happen that are the next of both molecules (choose.pass.glsl beside this file), or where no sphere moves others, of
// both spheres.
const bool isFirst = false;
#pragma updates places sphereMotions impacts impactRounds impactSlots impactGroups choices
#pragma writes nextPlaces nextMotions nextImpacts
#include "contact/response/impact.glsl"

Choice choiceOf(int slot)
{
    return listedOf(slot) > 0 ? choiceFrom(choicesAt(slot)) : noChoice;
}

// Returns the slot that has the next impact of its molecule.
int nextOf(int slot)
{
    if (!SPREADS) return slot;
    Molecule molecule = moleculeOf(slot);
    int best = slot;
    Choice first = choiceOf(slot);
    for (int k = 0; k < molecule.spheres; ++k) {
        int sphere = slotOfSphere(molecule, k);
        Choice choice = choiceOf(sphere);
        if (choice.other == NOBODY || (first.other != NOBODY && !isBefore(sphere, choice, best, first))) continue;
        best = sphere;
        first = choice;
    }
    return best;
}

// Whether the other of a slot's choice has it as well; what nothing moves has none.
bool agrees(int slot, int other)
{
    if (sphereAt(other).weight == 0.0) return true;
    return choiceOf(other).other == uint(slot) && nextOf(other) == other;
}

#ifdef TEXTURES
void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    Struck next = struckAs(slot);
    int struck = nextOf(slot);
    Choice choice = choiceOf(struck);
    int other = int(choice.other);
    if (choice.other != NOBODY && agrees(struck, other)) {
        loadSphere(struck);
        Sphere sphere = sphereAt(other);
        PairImpact impact = impactOf(struck, other, sphere);
        vec3 impulse = impulseOf(impact, sphere, bodyOf(other, sphere));
        next = struckBy(slot, struck, other, impulse, impact.since, choiceOf(slot).entry);
    }
    putNextPlaces(slot, next.place);
    putNextMotions(slot, next.motion);
    putAllNextImpacts(slot, next.impacts);
}
#else
#include "contact/response/strike.glsl"

uniform int roundNumber;  // from 1

// Lets a slot, and all that it may touch, choose anew, where that is more than the other that it has met.
void chooseAnew(int slot)
{
    if (!SPREADS) putChoices(slot, packedChoice(noChoice));
    if (listedOf(slot) < (SPREADS ? 1 : 2)) return;
    for (int e = -1; e < listedOf(slot); ++e) {
        int chooser = e < 0 ? slot : int(listsAt(slot, e));
        if (!rests(chooser) && atomicExchange(impactRoundsBuffer[chooser], uint(roundNumber + 1)) == 0u) listSlot(chooser);
    }
}

// The same for all that an impact of the slot has moved.
void allChooseAnew(int slot)
{
    if (!SPREADS) {
        chooseAnew(slot);
        return;
    }
    Molecule molecule = moleculeOf(slot);
    for (int k = 0; k < molecule.spheres; ++k) chooseAnew(slotOfSphere(molecule, k));
}

void main()
{
    if (gl_GlobalInvocationID.x >= impactGroupsBuffer[3]) return;
    int slot = int(impactSlotsAt(ownNumber()));
    Choice choice = choiceOf(slot);
    if (choice.other == NOBODY) return;
    int other = int(choice.other);
    if (nextOf(slot) != slot || !agrees(slot, other)) {
        putImpactRounds(slot, uint(roundNumber + 1));
        return;
    }
    bool isOther = sphereAt(other).weight > 0.0;
    if (isOther && slot > other) return;
    loadSphere(slot);
    strike(slot, other, uvec2(choice.entry, isOther ? choiceOf(other).entry : 0u));
    allChooseAnew(slot);
    if (isOther) allChooseAnew(other);
}
#endif
