// The colliders near each sphere of one group, in fragments, where a pass that writes them writes nothing else.
#include "contact/grid/state_sphere.glsl"
#pragma writes colliders

void main()
{
    int lane = ownLane();
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    putAllColliders(firstNumber + lane, packedColliders(nearColliders(sphereOfState(molecule, k), k)));
}
