// With buffers, an impact, and the list of slots that have others to choose from.
#include "contact/response/impact.glsl"

void put(int slot, Struck next)
{
    putPlaces(slot, next.place);
    putSphereMotions(sphereOf(slot), next.motion);
    putAllImpacts(slot, next.impacts);
}

// Moves all that take part of the molecule of a slot, or that slot alone where none moves others.
void strikeAll(int slot, Impact impact)
{
    if (!SPREADS) {
        put(slot, struckBy(slot, impact));
        return;
    }
    Molecule molecule = moleculeOf(slot);
    for (int k = 0; k < molecule.spheres; ++k) {
        int each = slotOfSphere(molecule, k);
        if (countsAt(each) != 0u) put(each, struckBy(each, impact));
    }
}

// Strikes both sides of the impact that a slot has chosen: a lane does, because neither may be seen half struck.
void strike(int slot, Choice choice)
{
    int other = int(choice.other);
    Impact impact = impactAt(slot, choice);
    bool isOneMolecule = SPREADS && placesAt(slot).w == placesAt(other).w;
    bool movesOther = sphereAt(other).weight > 0.0 && !isOneMolecule;
    for (int side = movesOther ? other : slot;; side = slot) {  // as one text, it compiles in half the time
        strikeAll(side, impact);
        if (side == slot) break;
    }
}

// Lists a slot for the rounds, from the next one on.
void listSlot(int slot)
{
    uint place = atomicAdd(impactGroupsBuffer[4], 1u);
    if (isFirst) atomicAdd(impactGroupsBuffer[3], 1u);
    atomicMax(impactGroupsBuffer[0], place / 64u + 1u);
    putImpactGroups(0, 1, 1u);
    putImpactGroups(0, 2, 1u);
    putImpactSlots(place, uint(slot));
}
