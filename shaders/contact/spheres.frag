// spheres: a texel a sphere, of one group: from the state to records in the spheres' own order (contact/records.glsl).
#include "state/textures.glsl"
#include "state/numbered.glsl"
#include "physics/cells.glsl"

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
    ivec2 texel = stateTexel(vertex, molecule);
    vec3 anchor = texelFetch(records, recordTexel(molecule), 0).xyz;
    vec3 position = texelFetch(positions, texel, 0).xyz;
    vec3 velocity = texelFetch(velocities, texel, 0).xyz;
    vec4 ownInertia = inertia(vertex);
    float weight = isHeld(ownInertia, molecule) ? 0.0 : ownInertia.x;
    float scale = texelFetch(constants, recordTexel(molecule), 0).y;
    CellPlace place = cellPlace(anchor, position, cell);
    newPlace = uvec4(floatBitsToUint(place.local), uint(label + molecule));
    newMotion = uvec4(floatBitsToUint(velocity), floatBitsToUint(weight));
    newCell = uvec4(uvec3(place.cell), floatBitsToUint(radius * scale));
}
