// A sphere of one group, as a pass over the group's spheres makes it from the state.
#include "physics/cells.glsl"
#include "contact/flags.glsl"
#include "contact/response/body.glsl"

uniform float cell;
uniform float givenRadius;
uniform float contactStep;  // s

struct StateSphere {
    vec3 anchor;    // m
    vec3 position;  // m, from there
    vec3 velocity;  // m/s
    float weight;   // 1/kg
    float radius;   // m
    bool lives;     // its molecule lives
    bool fresh;     // and has been born since the last contact step
};

CellPlace cellPlaceOf(StateSphere own, int sphere, vec3 shift)
{
    CellPlace place = cellPlace(own.anchor, own.position + shift, cell);
    if (!own.lives) place.cell = cellApart(sphere);
    return place;
}
