// Collects the slots that take part in the response.
#pragma updates responding

// The words that glDispatchComputeIndirect takes: workgroups of 64 lanes, a lane a slot that takes part. They have a buffer of their
// own, because a driver may watch over the whole buffer that it takes them from.
layout(std430) buffer RespondingGroups {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};

void noneResponds()
{
    respondingBuffer[0] = 0u;
    groupsX = 0u;
    groupsY = 1u;
    groupsZ = 1u;
}

void addResponding(int slot)
{
    uint place = atomicAdd(respondingBuffer[0], 1u);
    atomicMax(groupsX, place / 64u + 1u);
    respondingBuffer[1u + place] = uint(slot);
}
