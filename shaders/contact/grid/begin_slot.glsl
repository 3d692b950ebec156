// What every slot begins a step with, with buffers.
#include "state/lanes.glsl"
#include "contact/search/respond.glsl"
#include "generated/mark_groups.glsl"
#pragma reads spherePlaces sphereCells
#pragma writes slots marks

void beginSlot(int slot, uint sphere)
{
    putSlots(sphere, uint(slot));
    putMarks(slot, 0u);
    if (gl_GlobalInvocationID.x == 0u) {
        noneResponds();
        noneMarked();
    }
}
