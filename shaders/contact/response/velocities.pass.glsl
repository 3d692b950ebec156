// How the totals so far move the spheres of one group, each of which may move others (contact/response/changes.glsl). With buffers a lane has
// a sphere, or with RIGID a molecule.
#include "contact/response/changes.glsl"
#pragma writes velocities

#ifdef TEXTURES
#include "contact/group_sphere.glsl"

void main()
{
    int lane = ownSphereOfGroup();
    int molecule = lane / SPHERES;
    Total change = changeOf(molecule, lane - molecule * SPHERES);
    putVelocities(ownNumber(), 0, vec4(velocityAt(ownNumber()) + change.impulse, 0.0));
    putVelocities(ownNumber(), 1, vec4(change.shift, 0.0));
}
#else
#include "contact/rest/resting.glsl"
#pragma reads sphereMotions

void put(int sphere, Total change)
{
    int slot = slotOf(sphere);
    putVelocities(slot, 0, vec4(uintBitsToFloat(sphereMotionsAt(sphere).xyz) + change.impulse, 0.0));
    putVelocities(slot, 1, vec4(change.shift, 0.0));
}

void main()
{
    int lane = ownLane();
#ifdef RIGID
    int molecule = lane;
    int own = 0;
#else
    int molecule = lane / SPHERES;
    int own = lane - molecule * SPHERES;
#endif
    int first = moleculeSphere(molecule);
    bool moves = !rests(slotOf(first + own));  // a loop, which a CPU rasteriser leaves where no lane stays (contact/search/search.glsl)
    while (moves) {
#ifdef RIGID
        BodyTotal body = totalOfBody(molecule);
        for (int k = 0; k < SPHERES; ++k) put(first + k, changeIn(body, molecule, k));
#else
        put(first + own, changeOf(molecule, own));
#endif
        moves = false;
    }
}
#endif
