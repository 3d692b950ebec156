// A pass over the spheres of one group: with buffers a lane has a sphere or, with RIGID, a molecule; in fragments a texel has a slot, and those
// of other groups' spheres are left as they are.
#include "contact/slots.glsl"
#include "contact/grid/shape.glsl"

const bool oneForMolecule = RIGID && !inTextures;

uniform int groupSpheres;

// Returns which sphere of the group, or which molecule, from 0.
int ownLaneOfGroup()
{
    if (!inTextures) return ownLane();
    int lane = sphereOf(ownNumber()) - firstSphere;
    if (ownNumber() >= count || lane < 0 || lane >= groupSpheres) discardTexel();
    return lane;
}
