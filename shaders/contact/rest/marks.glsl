// The marks that a step gives slots whose molecule rests (contact/flags.glsl), and a list of the marked ones.
#include "contact/flags.glsl"
#include "contact/rest/mark_groups.glsl"
#pragma updates marks markedSlots

void mark(int slot, uint flags)
{
    if (atomicOr(marksBuffer[slot], flags) != 0u) return;
    uint place = atomicAdd(marked, 1u);
    atomicMax(markedX, place / 64u + 1u);
    putMarkedSlots(place, uint(slot));
}
