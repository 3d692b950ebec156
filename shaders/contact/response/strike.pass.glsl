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

// Whether a slot's choice happens: it is the next of both molecules.
bool happens(int slot, Choice choice)
{
    if (choice.other == NOBODY || !isMutual(slot, choice) || nextOf(slot) != slot) return false;
    int other = int(choice.other);
    return sphereAt(other).weight == 0.0 || nextOf(other) == other;
}

#ifdef TEXTURES
void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    Struck next = struckAs(slot);
    int struck = nextOf(slot);
    if (happens(struck, choiceOf(struck))) {
        int other = int(choiceOf(struck).other);
        if (sphereAt(other).weight > 0.0) struck = min(struck, other);  // both sides begin with the same
        next = struckBy(slot, impactAt(struck, choiceOf(struck)));
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
    int other = int(choice.other);
    bool isOther = choice.other != NOBODY && sphereAt(other).weight > 0.0;
    bool strikes = !(isOther && slot > other) && happens(slot, choice);
    while (strikes) {  // rare (contact/search/find.pass.glsl)
        strike(slot, choice);
        for (int side = slot;; side = other) {
            allChooseAnew(side);
            if (!isOther || side == other) break;
        }
        strikes = false;
    }
}
#endif
