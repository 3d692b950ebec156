// How the slots that touch something are put together.
#include "contact/touching.glsl"

// The words that glDispatchComputeIndirect takes: workgroups of 64 lanes, a lane a slot that touches. In a buffer of its own, so that a
// driver that looks after such a buffer looks after no more.
layout(std430, binding = 6) buffer Groups {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};

void noneTouches()
{
    touching = 0u;
    groupsX = 0u;
    groupsY = 1u;
    groupsZ = 1u;
}

void addTouching(int slot)
{
    uint at = atomicAdd(touching, 1u);
    atomicMax(groupsX, at / 64u + 1u);
    touchingSlots[at] = uint(slot);
}
