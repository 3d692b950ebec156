// The colliders near each sphere of one group, in fragments, where a pass that writes them writes nothing else.
#include "contact/grid/state_sphere.glsl"
#include "contact/grid/near_colliders.glsl"

void main()
{
    int lane = ownLane();
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    putNearColliders(firstNumber + lane, sphereOfState(molecule, k), k);
}
