// A lane a slot, where molecules may rest: lists what is awake, and marks what rests and has touched something that is awake now.
#include "state/lanes.glsl"
#include "contact/rest/marks.glsl"
#include "contact/response/memory.glsl"
#pragma writes awakeSlots counts

void main()
{
    if (isBehindLast()) return;
    int slot = int(gl_GlobalInvocationID.x);
    if (!rested(slot)) {
        uint place = atomicAdd(awake, 1u);
        atomicMax(awakeX, place / 64u + 1u);
        putAwakeSlots(place, uint(slot));
        return;
    }
    putCounts(slot, 0u);
    int sphere = sphereOf(slot);
    bool touched = false;
    for (int e = rememberedBy(sphere) - 1; e >= 0; --e) touched = touched || !rested(partnerSlot(sphere, e));
    if (touched) mark(slot, TOUCHED);
}
