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
    newImpulse = vec4(impulse, 0.0);
#ifdef WALLS
    vec4 wall = wallOf(slot);
    if (isNear(wall) && own.weight > 0.0) respondToWall(slot, wall);
    newImpulse = vec4(impulse, wallPush);
#endif
    storeMore(slot);
    newStored = stored;
}
