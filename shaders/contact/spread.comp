// A lane a sphere of one group: contact/spread.glsl.
#include "contact/shape.glsl"
#include "contact/spread.glsl"

uniform usamplerBuffer motions;

layout(std430, binding = 0) writeonly buffer Velocities { vec4 newVelocities[]; };

layout(std430, binding = 1) writeonly buffer Moves { vec4 newMoves[]; };

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int sphere = firstSphere + lane;
    vec3 change = velocityChange(molecule, lane - molecule * SPHERES);
    vec3 velocity = uintBitsToFloat(texelFetch(motions, sphere).xyz) + change;
    ofShifts = true;
    newMoves[int(texelFetch(slots, sphere).x)] = vec4(velocityChange(molecule, lane - molecule * SPHERES), 0.0);
    newVelocities[int(texelFetch(slots, sphere).x)] = vec4(velocity, 0.0);
}
