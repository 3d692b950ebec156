// The spheres of one group, from the state, in the order of their numbers. With buffers a lane writes the key of its cell as well, with the
// sphere's number or, with COUNTED, with how many spheres of the cell have come before it; and the colliders near it.
#if defined(TEXTURES) && !defined(LAYERED)
#include "contact/grid/textures_sphere.glsl"
#else
#include "contact/grid/state_sphere.glsl"
#endif
#pragma writes spherePlaces sphereMotions sphereCells
#if defined(BODIES) || defined(RIGID)
#pragma writes bodies
#endif

uniform int label;  // of the group's first molecule

#ifndef TEXTURES
#ifdef RESTING
#pragma updates loads
#include "contact/rest/states.glsl"

uniform bool wakes;  // all molecules of the group
#elif defined(REMEMBERS)
#pragma writes loads
#endif
#ifdef WALLS
#pragma writes colliders
#endif
#ifdef COUNTED
#include "contact/grid/cell_counts.glsl"
#pragma writes arrivals
#else
#pragma writes sorted

uniform int keys;  // of the table of cells
#endif
#ifdef STAGGERED
uniform vec3 cellShift;  // m, of a second grid
uniform bool onlyKeys;   // the spheres have been written
#else
const vec3 cellShift = vec3(0.0);
const bool onlyKeys = false;
#endif

void putKey(int sphere, uint key)
{
#ifdef COUNTED
    if (isBehindLast()) return;
    putArrivals(sphere, uvec2(key, atomicAdd(cellCounts[key], 1u)));
    atomicAdd(cellCounts[placeOfTile(int(key) / CELL_TILE)], 1u);
#else
    putSorted(sphere, uvec2(key, uint(sphere)));
#endif
}
#else
const vec3 cellShift = vec3(0.0);
#endif

void main()
{
    int lane = ownLane();
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    int sphere = firstNumber + lane;
    StateSphere own = sphereOfState(molecule, k);
    CellPlace place = cellPlaceOf(own, sphere, cellShift);
    bool rests = false;
#ifndef TEXTURES
    putKey(sphere, cellKey(place.cell, uint(keys - 1)));
    if (onlyKeys) return;
#ifdef RESTING
    rests = isResting(loadsAt(sphere).w) && own.lives && !own.fresh && !wakes;
    if (rests) own.velocity = vec3(0.0);
    if (!rests) putLoads(sphere, vec4(0.0));
#elif defined(REMEMBERS)
    putLoads(sphere, vec4(0.0));
#endif
#ifdef WALLS
    putAllColliders(sphere, packedColliders(nearColliders(own, k)));
#endif
#endif
#ifdef RIGID
    BodySphere body = bodySphereOf(molecule, own.position);
    own.weight = body.perMass;
    putAllBodies(sphere, packedBody(body));
#elif defined(BODIES)
    putAllBodies(sphere, vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)));
#endif
    putSpherePlaces(sphere, uvec4(floatBitsToUint(place.local), uint(label + molecule)));
    putSphereMotions(sphere, uvec4(floatBitsToUint(own.velocity), withFlag(own.weight, own.fresh)));
    putSphereCells(sphere, uvec4(uvec3(place.cell), withFlag(own.radius, rests)));
}
