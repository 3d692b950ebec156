// velocities: a texel a slot, of the spheres of one group: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/spread.glsl"
#include "contact/own_sphere.glsl"

uniform usampler2D motions;  // by slot

layout(location = 0) out vec4 newVelocity;

void main()
{
    int lane = ownSphere() - firstSphere;
    if (lane < 0 || lane >= partSpheres) discard;
    int molecule = lane / SPHERES;
    vec3 change = velocityChange(molecule, lane - molecule * SPHERES);
    newVelocity = vec4(uintBitsToFloat(fetch(motions, ownNumber()).xyz) + change, 0.0);
}
