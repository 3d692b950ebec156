// A lane a sphere of one group: from the state to records in the spheres' own order, and the key of its cell, with
// the sphere's number or, with COUNTED, with how many spheres of the cell have come before it.
#include "contact/shape.glsl"
#include "contact/state_sphere.glsl"

uniform int label;       // of the group's first molecule
uniform vec3 cellShift;  // m, of a staggered grid
uniform bool onlyKeys;   // the records have been written

layout(std430) writeonly buffer Keys { uvec2 pairs[]; };
#ifdef COUNTED
#include "contact/cell_counts.glsl"
#else
uniform int keys;  // of the table of cells
#endif
layout(std430) writeonly buffer SpherePlaces { uvec4 newPlaces[]; };
layout(std430) writeonly buffer Motions { uvec4 newMotions[]; };
layout(std430) writeonly buffer SphereCells { uvec4 newCells[]; };
#ifdef REMEMBERS
layout(std430) buffer Loads { vec4 loads[]; };  // contact/apply.comp leaves those of the next step
#endif
#ifdef RESTING
uniform bool wakes;  // all molecules of the group
#endif
#ifdef WALLS
layout(std430) writeonly buffer Walls { vec4 newWalls[]; };
#endif
#ifdef RIGID
layout(std430) writeonly buffer Bodies { vec4 newBodies[]; };
#endif

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int sphere = firstSphere + lane;
    StateSphere own = sphereOfState(molecule, lane - molecule * SPHERES);
    CellPlace place = cellPlaceOf(own, sphere, cellShift);
    uint key = cellKey(place.cell, uint(keys - 1));
#ifdef COUNTED
    if (int(gl_GlobalInvocationID.x) < partSpheres) {
        pairs[sphere] = uvec2(key, atomicAdd(cellCounts[key], 1u));
        atomicAdd(cellCounts[placeOfTile(int(key) / CELL_TILE)], 1u);
    }
#else
    pairs[sphere] = uvec2(key, uint(sphere));
#endif
    if (onlyKeys) return;
    uint radius = floatBitsToUint(own.radius);
#ifdef RESTING
    bool rests = loads[sphere].w > 0.0 && own.there && !own.fresh && !wakes;
    if (!rests) loads[sphere] = vec4(0.0);
    if (rests) {
        radius |= RESTS;
        own.velocity = vec3(0.0);
    }
#elif defined(REMEMBERS)
    loads[sphere] = vec4(0.0);
#endif
#ifdef RIGID
    BodySphere at = bodySphereOf(molecule, own.position);
    own.weight = at.perMass;
    vec4[3] body = packedBody(at);
    for (int i = 0; i < 3; ++i) newBodies[3 * sphere + i] = body[i];
#endif
    newPlaces[sphere] = uvec4(floatBitsToUint(place.local), uint(label + molecule));
    newMotions[sphere] = uvec4(floatBitsToUint(own.velocity), weightBits(own));
    newCells[sphere] = uvec4(uvec3(place.cell), radius);
#ifdef WALLS
    Wall near[MOST_WALLS] = nearWalls(own, lane - molecule * SPHERES);
    for (int k = 0; k < MOST_WALLS; ++k) {
        newWalls[2 * (MOST_WALLS * sphere + k)] = vec4(near[k].normal, near[k].gap);
        newWalls[2 * (MOST_WALLS * sphere + k) + 1] = vec4(near[k].velocity, near[k].friction);
    }
#endif
}
