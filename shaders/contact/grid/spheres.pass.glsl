// The spheres of one group, from the state, in the order of their numbers. With buffers a lane writes the key of its cell as well, and the
// colliders near it. C++ chooses the files: how the state has a sphere, how its key is kept, and how colliders are looked for.
#include "generated/sphere.glsl"
#include "contact/rest/states.glsl"
#pragma writes spherePlaces sphereMotions sphereCells bodies
#pragma updates loads when buffers
#include "generated/key.glsl"
#include "generated/sphere_colliders.glsl"

uniform int label;       // of the group's first molecule
uniform bool wakes;      // all molecules of the group
uniform vec3 cellShift;  // m, of a second grid
uniform bool onlyKeys;   // the spheres have been written

void main()
{
    const bool isSecond = STAGGERS && !inTextures;
    int lane = ownLane();
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    int sphere = firstNumber + lane;
    StateSphere own = sphereOfState(molecule, k);
    CellPlace place = cellPlaceOf(own, sphere, isSecond ? cellShift : vec3(0.0));
    putKey(sphere, place.cell);
    if (isSecond && onlyKeys) return;
    bool rests = RESTS && isResting(loadsAt(sphere).w) && own.lives && !own.fresh && !wakes;
    if (rests) own.velocity = vec3(0.0);
    if (!rests) putLoads(sphere, vec4(0.0));
    putNearColliders(sphere, own, k);
    BodySphere body = bodySphereOf(molecule, own.position);
    if (RIGID) own.weight = body.perMass;
    putAllBodies(sphere, packedBody(body));
    putSpherePlaces(sphere, uvec4(floatBitsToUint(place.local), uint(label + molecule)));
    putSphereMotions(sphere, uvec4(floatBitsToUint(own.velocity), withFlag(own.weight, own.fresh)));
    putSphereCells(sphere, uvec4(uvec3(place.cell), withFlag(own.radius, rests)));
}
