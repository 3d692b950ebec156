// A sphere of one group as the textures of the ping-pong path have it.
#include "state/lanes.glsl"
#include "state/topology.glsl"
#include "state/textures.glsl"
#include "physics/cells.glsl"
#include "contact/flags.glsl"
#include "contact/response/body.glsl"

uniform float cell;
uniform float givenRadius;

struct StateSphere {
    vec3 anchor;    // m
    vec3 position;  // m, from there
    vec3 velocity;  // m/s
    float weight;   // 1/kg
    float radius;   // m
    bool lives;     // always, here
    bool fresh;     // never, here
};

StateSphere sphereOfState(int molecule, int vertex)
{
    ivec2 texel = stateTexel(vertex, molecule);
    vec4 own = inertia(vertex);
    return StateSphere(texelFetch(records, recordTexel(molecule), 0).xyz, texelFetch(positions, texel, 0).xyz,
                       texelFetch(velocities, texel, 0).xyz, isHeld(own, molecule) ? 0.0 : own.x,
                       givenRadius * texelFetch(constants, recordTexel(molecule), 0).y, true, false);
}

// None is rigid here.
BodySphere bodySphereOf(int molecule, vec3 place)
{
    return BodySphere(vec3(0.0), 0.0, mat3(0.0), 0.0);
}

CellPlace cellPlaceOf(StateSphere own, int sphere, vec3 shift)
{
    return cellPlace(own.anchor, own.position + shift, cell);
}
