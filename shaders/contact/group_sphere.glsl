// A pass over slots, in fragments, that writes only those of one group's spheres.
#include "contact/slots.glsl"
#include "contact/grid/shape.glsl"

uniform int groupSpheres;

// Returns which of them has this texel's slot, from 0.
int ownSphereOfGroup()
{
    int lane = sphereOf(ownNumber()) - firstSphere;
    if (ownNumber() >= count || lane < 0 || lane >= groupSpheres) discard;
    return lane;
}
