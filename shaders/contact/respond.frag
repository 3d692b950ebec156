// respond: a texel a slot, a stage of contact/respond.glsl.
#include "generated/stage.glsl"

layout(location = 0) out vec4 newImpulse;
layout(location = 1) out vec4 newStored[LIST / 4];  // guess, relax: the pushes; friction: the shift

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? min(int(fetch(counts, slot).x), LIST) : 0;
    if (listed == 0) discard;
    for (int i = 0; i < LIST / 4; ++i) stored[i] = vec4(0.0);
    respond(slot, listed);
    storeMore(slot);
    newImpulse = vec4(impulse, 0.0);
    newStored = stored;
}
