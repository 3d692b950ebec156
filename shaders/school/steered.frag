// A texel a molecule of one group: what school/steer.frag has written at its slot.
#include "school/bodies.glsl"
#include "school/grid.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform usampler2D starts;
uniform sampler2DArray steered;  // in the order of the grids
uniform ivec4 grid;              // first slot, slots, first key, keys
uniform float inverseCell;
uniform int firstBody;           // of the group
uniform int entries;             // of all grids

layout(location = 0) out vec4 newSteering[STEERING_ELEMENTS];

void main()
{
    // texels past the last molecule do what it does
    int molecule = min(int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x), grid.y - 1);
    int body = firstBody + molecule;
    int key = grid.z + cellKey(cellOf(bodyElement(body, 0).xyz, inverseCell), grid.w);
    int slot = placeOfNumber(sorted, uint(body), int(fetch(starts, key).x), entries);
    vec4 own[STEERING_ELEMENTS];
    for (int e = 0; e < STEERING_ELEMENTS; ++e) own[e] = texelFetch(steered, ivec3(texelOf(slot), e), 0);
    newSteering = own;
}
