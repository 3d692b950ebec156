// A texel a molecule of one group: what school/steer.pass.glsl has written at its slot.
#include "school/grid.glsl"
#include "sort/pairs.glsl"
#pragma reads bodies sorted starts steered

uniform ivec4 grid;         // first slot, slots, first key, keys
uniform float inverseCell;
uniform int firstBody;      // of the group
uniform int entries;        // of all grids

layout(location = 0) out vec4 newSteering[STEERING_ELEMENTS];

void main()
{
    // texels past the last molecule do what it does
    int molecule = min(int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x), grid.y - 1);
    int body = firstBody + molecule;
    int key = grid.z + cellKey(cellOf(bodiesAt(body, 0).xyz, inverseCell), grid.w);
    int slot = placeOfNumber(sorted, uint(body), int(startsAt(key)), entries);
    vec4 own[STEERING_ELEMENTS];
    for (int e = 0; e < STEERING_ELEMENTS; ++e) own[e] = steeredAt(slot, e);
    newSteering = own;
}
