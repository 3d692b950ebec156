// The spheres of one group, from the state, in the order of their numbers. With buffers a lane writes the key of its cell as well, and the
// colliders near it; in fragments a pass of its own writes these (COLLIDES), because a pass writes eight texels at most. C++ chooses the file
// that knows how the state has a sphere.
#include "generated/sphere.glsl"
#include "contact/rest/states.glsl"
#if defined(COLLIDES) && defined(TEXTURES)
#include "contact/grid/near_colliders.glsl"

void main()
{
    int lane = ownLane();
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    putNearColliders(firstNumber + lane, sphereOfState(molecule, k), k);
}
#else
#pragma writes spherePlaces sphereMotions sphereCells bodies
#pragma updates loads when buffers
#ifdef CELL_TILE
#include "contact/grid/cell_counts.glsl"
#pragma writes arrivals

// Which cell a sphere lies in, and how many spheres of the cell have come before it.
void putKey(int sphere, ivec3 cell)
{
    if (isBehindLast()) return;
    uint key = cellKey(cell, uint(keys - 1));
    putArrivals(sphere, uvec2(key, atomicAdd(cellCounts[key], 1u)));
    atomicAdd(cellCounts[placeOfTile(int(key) / CELL_TILE)], 1u);
}
#else
#pragma writes sorted when buffers

uniform int keys;  // of the table of cells

// The key of the cell of a sphere, to be sorted; in fragments contact/grid/keys.pass.glsl makes it.
void putKey(int sphere, ivec3 cell)
{
    putSorted(sphere, uvec2(cellKey(cell, uint(keys - 1)), uint(sphere)));
}
#endif
#include "contact/grid/near_colliders.glsl"

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
#endif
