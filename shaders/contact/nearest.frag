// nearest: a texel a slot, contact/nearest.glsl.
#include "contact/nearest.glsl"

layout(location = 0) out vec4 newImpulse;
layout(location = 1) out vec4 newShift;

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? listedOf(slot) : 0;
    if (listed == 0) discard;
    Nearest response = respondToNearest(slot, listed);
    newImpulse = vec4(response.impulse, 0.0);
    newShift = vec4(response.shift, 0.0);
}
