// A lane a sphere of one group: from the state to records in the spheres' own order, and the key of its cell.
#include "contact/shape.glsl"
#include "physics/cells.glsl"

uniform samplerBuffer oldState;
uniform samplerBuffer oldRecords;
#ifdef CONSTANTS
uniform samplerBuffer constants;
#endif
uniform int label;           // of the group's first molecule
uniform int keyMask;
uniform float cell;
uniform float givenRadius;
uniform vec3 cellShift;      // m, of a staggered grid
uniform bool onlyKeys;       // the records have been written

layout(std430, binding = 0) writeonly buffer Pairs { uvec2 pairs[]; };
layout(std430, binding = 1) writeonly buffer Places { uvec4 newPlaces[]; };
layout(std430, binding = 2) writeonly buffer Motions { uvec4 newMotions[]; };
layout(std430, binding = 3) writeonly buffer Cells { uvec4 newCells[]; };

#ifdef WALLS
#include "generated/colliders.glsl"
#include "step/wall.glsl"

uniform float wallTime;   // s, since the frame's start
uniform float wallStep;   // s, of a contact step
uniform float wallNudge;  // m

// The collider nearest to each sphere: xyz unit normal, w the centre's distance from its surface, m; 1e30:
// none is near.
layout(std430, binding = 4) writeonly buffer Walls { vec4 newWalls[]; };

void findWall(int sphere, vec3 anchor, vec3 position, vec3 velocity, float radius)
{
    float distance = clearance(anchor, position, wallTime);
    vec4 wall = vec4(0.0, 1.0, 0.0, 1e30);
    bool near = distance < 0.25 * radius + length(velocity) * wallStep;
    while (near) {
        vec3 slope = wallSlope(anchor, position, wallTime, wallNudge, distance);
        float steep = length(slope);
        if (steep > 0.1 * wallNudge && steep < 1e20) wall = vec4(slope / steep, max(distance, 0.0));
        near = false;
    }
    newWalls[sphere] = wall;
}
#endif

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int k = lane - molecule * SPHERES;
    vec4 record = texelFetch(oldRecords, molecule);
    bool released = record.w < 0.0;
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec4 shape = shapeOf(k);
#ifdef TRIANGLES
    ivec3 corners = k < VERTICES ? ivec3(k) : ivec3(shape.xyz);
    vec3 position = (packedVertex(oldState, first, 0, corners.x) + packedVertex(oldState, first, 0, corners.y) +
                     packedVertex(oldState, first, 0, corners.z)) / 3.0;
    vec3 velocity = (packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) + packedVertex(oldState, first, POSITION_ELEMENTS, corners.y) +
                     packedVertex(oldState, first, POSITION_ELEMENTS, corners.z)) / 3.0;
    // an impulse on the middle is a third on each corner
    float weight = (weightOf(shapeOf(corners.x), released) + weightOf(shapeOf(corners.y), released) +
                    weightOf(shapeOf(corners.z), released)) / 9.0;
    bool isVertex = k < VERTICES;
    position = isVertex ? packedVertex(oldState, first, 0, corners.x) : position;
    velocity = isVertex ? packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) : velocity;
    weight = isVertex ? weightOf(shape, released) : weight;
#else
    vec3 position = packedVertex(oldState, first, 0, k);
    vec3 velocity = packedVertex(oldState, first, POSITION_ELEMENTS, k);
    float weight = weightOf(shape, released);
#endif
    float scale = 1.0;
    float radius = givenRadius;
#ifdef CONSTANTS
    scale = texelFetch(constants, molecule).x;
#endif
    CellPlace place = cellPlace(record.xyz, position + cellShift, cell);
    int sphere = firstSphere + lane;
#ifdef LIFE
    if (!(packedLife(oldState, first).y > 0.0)) {
        place.cell = cellApart(sphere);
        radius = 0.0;
    }
#endif
    pairs[sphere] = uvec2(cellKey(place.cell, uint(keyMask)), uint(sphere));
    if (onlyKeys) return;
    newPlaces[sphere] = uvec4(floatBitsToUint(place.local), uint(label + molecule));
    newMotions[sphere] = uvec4(floatBitsToUint(velocity), floatBitsToUint(weight));
    newCells[sphere] = uvec4(uvec3(place.cell), floatBitsToUint(radius * scale));
#ifdef WALLS
    findWall(sphere, record.xyz, position, velocity, radius * scale);
#endif
}
