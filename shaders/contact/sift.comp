// A lane a slot, where molecules may rest: lists what is awake, and marks what rests and has touched something that is awake now.
#include "contact/marks.glsl"
#include "contact/records.glsl"

uniform samplerBuffer known;  // contact/memory.glsl
uniform int listStride;
#include "contact/recalled.glsl"

layout(std430, binding = 0) writeonly buffer AwakeSlots { uint awakeSlots[]; };
layout(std430, binding = 1) writeonly buffer Counts { uint counts[]; };

bool rests(int slot)
{
    return (fetch(cells, slot).w & RESTS) != 0u;
}

void main()
{
    int slot = int(gl_GlobalInvocationID.x);
    if (slot >= count) return;
    bool resting = rests(slot);
    if (!resting) {
        uint at = atomicAdd(awake, 1u);
        atomicMax(awakeX, at / 64u + 1u);
        awakeSlots[at] = uint(slot);
    }
    while (resting) {
        counts[slot] = 0u;
        bool touched = false;
        for (int e = oldCount(slot) - 1; e >= 0; --e) touched = touched || !rests(oldPartner(slot, e));
        if (touched) mark(slot, TOUCHED);
        resting = false;
    }
}
