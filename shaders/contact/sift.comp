// A lane a slot, where molecules may rest: lists what is awake, and marks what rests and has touched something that is awake now.
#include "contact/marks.glsl"
#include "contact/records.glsl"

uniform samplerBuffer known;  // contact/memory.glsl
uniform int listStride;
#include "contact/recalled.glsl"

layout(std430) writeonly buffer AwakeSlots { uint awakeSlots[]; };
layout(std430) writeonly buffer Counts { uint counts[]; };

void main()
{
    int slot = int(gl_GlobalInvocationID.x);
    if (slot >= count) return;
    if (!rested(slot)) {
        uint at = atomicAdd(awake, 1u);
        atomicMax(awakeX, at / 64u + 1u);
        awakeSlots[at] = uint(slot);
        return;
    }
    counts[slot] = 0u;
    int sphere = sphereOf(slot);
    bool touched = false;
    for (int e = oldCount(sphere) - 1; e >= 0; --e) touched = touched || !rested(oldPartner(sphere, e));
    if (touched) mark(slot, TOUCHED);
}
