// With buffers, an impact of two spheres, and the list of slots that have others to choose from.
#include "contact/response/impact.glsl"

void put(int slot, Struck next)
{
    putPlaces(slot, next.place);
    putSphereMotions(sphereOf(slot), next.motion);
    putAllImpacts(slot, next.impacts);
}

// Moves all that take part of the molecule of slot a, or that slot alone where none moves others. `entries`: of b in the list of a, and of a in
// that of b.
void strikeAll(int a, int b, vec3 impulse, float since, uvec2 entries)
{
    if (!SPREADS) {
        put(a, struckBy(a, a, b, impulse, since, entries.x));
        return;
    }
    Molecule molecule = moleculeOf(a);
    for (int k = 0; k < molecule.spheres; ++k) {
        int slot = slotOfSphere(molecule, k);
        if (countsAt(slot) != 0u) put(slot, struckBy(slot, a, b, impulse, since, slot == a ? entries.x : entries.y));
    }
}

// Strikes both spheres of an impact, the own one and another: a lane does, because neither may be seen half struck. `entries`: of the other
// in the own list, and of the own one in the other's.
void strike(int slot, int other, uvec2 entries)
{
    Sphere sphere = sphereAt(other);
    PairImpact impact = impactOf(slot, other, sphere);
    vec3 impulse = impulseOf(impact, sphere, bodyOf(other, sphere));
    bool isOneMolecule = SPREADS && placesAt(slot).w == placesAt(other).w;
    if (sphere.weight > 0.0 && !isOneMolecule) strikeAll(other, slot, -impulse, impact.since, entries.yx);
    strikeAll(slot, other, impulse, impact.since, entries);
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
