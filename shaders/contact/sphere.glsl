// A sphere of one group as the fused step's state has it. Needs contact/shape.glsl.
#include "physics/cells.glsl"

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;
uniform float cell;
uniform float givenRadius;

struct StateSphere {
    vec3 anchor;    // m
    vec3 position;  // m, from there
    vec3 velocity;  // m/s
    float weight;   // 1/kg
    float radius;   // m
    bool there;     // its molecule lives
};

StateSphere sphereOfState(int molecule, int k)
{
    vec4 record = valueOf(oldRecords, molecule);
    bool released = record.w < 0.0;
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec4 shape = shapeOf(k);
    StateSphere own;
    own.anchor = record.xyz;
    own.there = true;
#ifdef TRIANGLES
    ivec3 corners = k < VERTICES ? ivec3(k) : ivec3(shape.xyz);
    vec3 position = (packedVertex(oldState, first, 0, corners.x) + packedVertex(oldState, first, 0, corners.y) +
                     packedVertex(oldState, first, 0, corners.z)) / 3.0;
    vec3 velocity = (packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) +
                     packedVertex(oldState, first, POSITION_ELEMENTS, corners.y) +
                     packedVertex(oldState, first, POSITION_ELEMENTS, corners.z)) / 3.0;
    // an impulse on the middle is a third on each corner
    float weight = (weightOf(shapeOf(corners.x), released) + weightOf(shapeOf(corners.y), released) +
                    weightOf(shapeOf(corners.z), released)) / 9.0;
    bool isVertex = k < VERTICES;
    own.position = isVertex ? packedVertex(oldState, first, 0, corners.x) : position;
    own.velocity = isVertex ? packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) : velocity;
    own.weight = isVertex ? weightOf(shape, released) : weight;
#else
    own.position = packedVertex(oldState, first, 0, k);
    own.velocity = packedVertex(oldState, first, POSITION_ELEMENTS, k);
    own.weight = weightOf(shape, released);
#endif
    float scale = 1.0;
#ifdef CONSTANTS
    scale = valueOf(constants, molecule).x;
#endif
    own.radius = givenRadius * scale;
#ifdef LIFE
    own.there = packedLife(oldState, first).y > 0.0;
    if (!own.there) own.radius = 0.0;
#endif
    return own;
}

CellPlace cellPlaceOf(StateSphere own, int sphere, vec3 shift)
{
    CellPlace place = cellPlace(own.anchor, own.position + shift, cell);
    if (!own.there) place.cell = cellApart(sphere);
    return place;
}

#ifdef WALLS
#include "generated/colliders.glsl"
#include "step/wall.glsl"

uniform float wallTime;   // s, since the frame's start
uniform float wallStep;   // s, of a contact step
uniform float wallNudge;  // m

// The nearest collider: xyz unit normal, w the centre's distance from its surface, m; 1e30: none is near.
vec4 nearWall(StateSphere own)
{
    float distance = clearance(own.anchor, own.position, wallTime);
    vec4 wall = vec4(0.0, 1.0, 0.0, 1e30);
    bool near = distance < 0.25 * own.radius + length(own.velocity) * wallStep;
    while (near) {
        vec3 slope = wallSlope(own.anchor, own.position, wallTime, wallNudge, distance);
        float steep = length(slope);
        if (steep > 0.1 * wallNudge && steep < 1e20) wall = vec4(slope / steep, max(distance, 0.0));
        near = false;
    }
    return wall;
}
#endif
