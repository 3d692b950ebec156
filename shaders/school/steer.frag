// A texel a slot of one school's grid, so that neighbouring texels look into the same cells; school/steered.frag brings what
// they write to the molecules.
#include "state/packed.glsl"
#include "school/steer.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform sampler2DArray steering;

layout(location = 0) out vec4 newSteering[STEERING_ELEMENTS];

void main()
{
    int slot = ownNumber();
    if (slot < grids[0].x || slot >= grids[0].x + grids[0].y) discard;
    int body = int(pairAt(sorted, slot).y);
    vec4 steered[STEERING_ELEMENTS];
    steer(body, slot, element(steering, body - firstBody, 2), steered);
    newSteering = steered;
}
