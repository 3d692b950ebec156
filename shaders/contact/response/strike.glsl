// With buffers, an impact of two spheres, and the list of slots that have others to choose from.
#include "contact/response/impact.glsl"

void put(int slot, Struck next)
{
    putPlaces(slot, next.place);
    putSphereMotions(sphereOf(slot), next.motion);
    putAllImpacts(slot, next.impacts);
}

// Strikes both spheres: a lane does, because neither may be seen half struck. `entry`: the own one in the other's list.
void strike(int slot, int other, Sphere sphere, uint e, uint entry)
{
    PairImpact impact = impactOf(slot, other, sphere);
    vec3 impulse = impulseOf(impact, sphere);
    Struck next = struckBy(slot, other, impulse, impact.since, e);
    if (sphere.weight > 0.0) put(other, struckBy(other, slot, -impulse, impact.since, entry));
    put(slot, next);
}

// Lists a slot for the rounds.
void listSlot(int slot)
{
    uint place = atomicAdd(impactGroupsBuffer[3], 1u);
    atomicMax(impactGroupsBuffer[0], place / 64u + 1u);
    putImpactGroups(0, 1, 1u);
    putImpactGroups(0, 2, 1u);
    putImpactSlots(place, uint(slot));
}
