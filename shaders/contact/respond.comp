// A lane a slot in contact: a stage of contact/respond.glsl.
#include "contact/touching.glsl"
#include "generated/stage.glsl"

layout(std430, binding = 0) writeonly buffer NewImpulses { vec4 newImpulses[]; };

void main()
{
    int taken = touchingSlot();
    int slot = max(taken, 0);
    respond(slot, taken < 0 ? 0 : min(int(texelFetch(counts, slot).x), LIST));
#ifdef WALLS
    vec4 wall = wallOf(slot);
    if (taken >= 0 && isNear(wall) && own.weight > 0.0) respondToWall(slot, wall);
#endif
    if (taken >= 0) {
        newImpulses[slot] = vec4(impulse, 0.0);
        storeMore(slot);
    }
}
