// Collects the slots that take part in the response.
#include "contact/touching.glsl"

// The words that glDispatchComputeIndirect takes: workgroups of 64 lanes, a lane a slot that takes part. They have a buffer of their
// own, because a driver may watch over the whole buffer that it takes them from.
layout(std430) buffer Groups {
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
