// spread: a texel a slot, of the spheres of one group: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/spread.glsl"
#include "contact/own_sphere.glsl"

uniform usampler2D motions;  // by slot

layout(location = 0) out vec4 newVelocity;
layout(location = 1) out vec4 newMove;

void main()
{
    int lane = ownSphere() - firstSphere;
    if (lane < 0 || lane >= partSpheres) discard;
    int molecule = lane / SPHERES;
    Total change = changeOf(molecule, lane - molecule * SPHERES);
    newVelocity = vec4(uintBitsToFloat(fetch(motions, ownNumber()).xyz) + change.impulse, 0.0);
    newMove = vec4(change.shift, 0.0);
}
