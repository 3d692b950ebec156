// spheres: a texel a sphere, of one group: from the state to records in the spheres' own order (contact/records.glsl). The
// state lies in the textures of passes or, with LAYERED, of the fused step.
#include "state/topology.glsl"
#include "state/numbered.glsl"
#include "physics/cells.glsl"

#ifdef LAYERED
#include "state/packed.glsl"

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;
uniform int vertexCount;
#else
#include "state/textures.glsl"
#endif

uniform int firstSphere;   // of the group
uniform int groupSpheres;
uniform int label;         // of the group's first molecule
uniform float cell;
uniform float radius;

layout(location = 0) out uvec4 newPlace;
layout(location = 1) out uvec4 newMotion;
layout(location = 2) out uvec4 newCell;

void main()
{
    int number = ownNumber() - firstSphere;
    if (number < 0 || number >= groupSpheres) discard;
    int molecule = number / vertexCount;
    int vertex = number - molecule * vertexCount;
    float scale = 1.0;
#ifdef LAYERED
    vec4 record = valueOf(oldRecords, molecule);
    vec3 anchor = record.xyz;
    vec3 position = packedVertex(oldState, molecule, 0, vertex);
    vec3 velocity = packedVertex(oldState, molecule, POSITION_ELEMENTS, vertex);
    vec4 ownInertia = table(topologyBase + vertexCount + vertex);
    bool held = false;
#ifdef PINS
    held = ownInertia.y > 0.5 && record.w >= 0.0;
#endif
#ifdef CONSTANTS
    scale = valueOf(constants, molecule).x;
#endif
#ifdef LIFE
    bool isFree = !(packedLife(oldState, molecule).y > 0.0);
#endif
#else
    ivec2 texel = stateTexel(vertex, molecule);
    vec3 anchor = texelFetch(records, recordTexel(molecule), 0).xyz;
    vec3 position = texelFetch(positions, texel, 0).xyz;
    vec3 velocity = texelFetch(velocities, texel, 0).xyz;
    vec4 ownInertia = inertia(vertex);
    bool held = isHeld(ownInertia, molecule);
    scale = texelFetch(constants, recordTexel(molecule), 0).y;
#endif
    float weight = held ? 0.0 : ownInertia.x;
    CellPlace place = cellPlace(anchor, position, cell);
    float ownRadius = radius * scale;
#ifdef LIFE
    if (isFree) {
        place.cell = cellApart(firstSphere + number);
        ownRadius = 0.0;
    }
#endif
    newPlace = uvec4(floatBitsToUint(place.local), uint(label + molecule));
    newMotion = uvec4(floatBitsToUint(velocity), floatBitsToUint(weight));
    newCell = uvec4(uvec3(place.cell), floatBitsToUint(ownRadius));
}
