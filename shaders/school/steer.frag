// A texel a molecule of one group.
#include "state/packed.glsl"
#include "school/steer.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform sampler2DArray steering;
uniform int entries;  // of all grids

layout(location = 0) out vec4 newSteering[STEERING_ELEMENTS];

void main()
{
    // texels past the last molecule do what it does
    int molecule = min(int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x), grids[0].y - 1);
    int body = firstBody + molecule;
    int key = grids[0].z + cellKey(cellOf(bodyElement(body, 0).xyz, gridRules[0].x), grids[0].w);
    int slot = placeOfNumber(sorted, uint(body), int(fetch(starts, key).x), entries);
    vec4 steered[STEERING_ELEMENTS];
    steer(body, slot, element(steering, molecule, 2), steered);
    newSteering = steered;
}
