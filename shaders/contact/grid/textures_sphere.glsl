// A sphere of one group as the textures of the ping-pong path have it.
#include "state/lanes.glsl"
#include "state/textures.glsl"
#include "contact/grid/sphere.glsl"

StateSphere sphereOfState(int molecule, int vertex)
{
    ivec2 texel = stateTexel(vertex, molecule);
    vec4 own = inertia(vertex);
    return StateSphere(texelFetch(records, recordTexel(molecule), 0).xyz, texelFetch(positions, texel, 0).xyz,
                       texelFetch(velocities, texel, 0).xyz, isHeld(own, molecule) ? 0.0 : own.x,
                       givenRadius * texelFetch(constants, recordTexel(molecule), 0).y, true, false);
}

BodySphere bodySphereOf(int molecule, vec3 place)
{
    return noBody;
}
