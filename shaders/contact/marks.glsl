// What a step marks slots with whose molecule rests (contact/flags.glsl), and a list of the marked ones.
layout(std430) buffer Marks { uint marks[]; };
layout(std430) buffer MarkedSlots { uint markedSlots[]; };
#include "contact/marked.glsl"

void mark(int slot, uint with)
{
    if (atomicOr(marks[slot], with) != 0u) return;
    uint at = atomicAdd(marked, 1u);
    atomicMax(markedX, at / 64u + 1u);
    markedSlots[at] = uint(slot);
}
