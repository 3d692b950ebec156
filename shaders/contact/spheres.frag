// spheres: a texel a sphere, of one group: from the state to records in the spheres' own order (contact/records.glsl). The
// state lies in the textures of passes or, with LAYERED, of the fused step. With BODIES a record has the rigid body of
// molecules that are one (RIGID).
#include "state/numbered.glsl"
#include "physics/cells.glsl"
#ifdef LAYERED
#include "contact/shape.glsl"
#include "contact/state_sphere.glsl"
#else
#include "state/topology.glsl"
#include "state/textures.glsl"

uniform float cell;
uniform float givenRadius;
uniform int firstSphere;  // of the group
uniform int partSpheres;
#endif
uniform int label;        // of the group's first molecule

layout(location = 0) out uvec4 newPlace;
layout(location = 1) out uvec4 newMotion;
layout(location = 2) out uvec4 newCell;
#ifdef BODIES
layout(location = 3) out vec4 newBodies[3];
#endif

void main()
{
    int number = ownNumber() - firstSphere;
    if (number < 0 || number >= partSpheres) discard;
#ifdef LAYERED
    int molecule = number / SPHERES;
    StateSphere own = sphereOfState(molecule, number - molecule * SPHERES);
    CellPlace place = cellPlaceOf(own, firstSphere + number, vec3(0.0));
#ifdef BODIES
    newBodies = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
#endif
#ifdef RIGID
    BodySphere at = bodySphereOf(molecule, own.position);
    own.weight = at.perMass;
    newBodies = packedBody(at);
#endif
    vec3 velocity = own.velocity;
    uint weight = weightBits(own);
    float radius = own.radius;
#else
    int molecule = number / vertexCount;
    int vertex = number - molecule * vertexCount;
    ivec2 texel = stateTexel(vertex, molecule);
    CellPlace place = cellPlace(texelFetch(records, recordTexel(molecule), 0).xyz, texelFetch(positions, texel, 0).xyz, cell);
    vec3 velocity = texelFetch(velocities, texel, 0).xyz;
    vec4 ownInertia = inertia(vertex);
    uint weight = floatBitsToUint(isHeld(ownInertia, molecule) ? 0.0 : ownInertia.x);
    float radius = givenRadius * texelFetch(constants, recordTexel(molecule), 0).y;
#endif
    newPlace = uvec4(floatBitsToUint(place.local), uint(label + molecule));
    newMotion = uvec4(floatBitsToUint(velocity), weight);
    newCell = uvec4(uvec3(place.cell), floatBitsToUint(radius));
}
