// How the totals so far move the spheres of one group, each of which may move others (contact/response/changes.glsl).
const bool applies = false;
#include "contact/group_sphere.glsl"
#include "contact/response/changes.glsl"
#include "contact/rest/resting.glsl"
#pragma writes velocities

void put(int sphere, Total change)
{
    int slot = inTextures ? ownNumber() : slotOf(sphere);
    putVelocities(slot, 0, vec4(velocityBefore(sphere) + change.impulse, 0.0));
    putVelocities(slot, 1, vec4(change.shift, 0.0));
}

void main()
{
    int lane = ownLaneOfGroup();
    int molecule = oneForMolecule ? lane : lane / SPHERES;
    int own = oneForMolecule ? 0 : lane - molecule * SPHERES;
    int first = moleculeSphere(molecule);
    bool moves = !rests(slotOf(first + own));  // a loop, which a CPU rasteriser leaves where no lane stays (contact/search/search.glsl)
    while (moves) {
        if (oneForMolecule) {
            BodyTotal body = totalOfBody(molecule);
            for (int k = 0; k < SPHERES; ++k) put(first + k, changeIn(body, molecule, k));
        } else {
            put(first + own, changeOf(molecule, own));
        }
        moves = false;
    }
}
