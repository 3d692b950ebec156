// Collects the slots that take part in the response.
#pragma updates responding

#include "contact/response/batches.glsl"

void noneResponds()
{
    respondingBuffer[0] = 0u;
    for (int b = 0; b < batches.length(); ++b) batches[b] = Batch(0u, 1u, 1u, 0u);
}

void addResponding(int slot)
{
    uint place = atomicAdd(respondingBuffer[0], 1u);
    atomicMax(batches[0].groupsX, place / 64u + 1u);
    respondingBuffer[1u + place] = uint(slot);
}
