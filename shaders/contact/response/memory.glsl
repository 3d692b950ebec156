// The memory that the last step has left of the contacts of a sphere: with buffers by sphere, so that a sphere that rests costs nothing; in fragments
// by the slot that it had.
#include "contact/slots.glsl"
#pragma reads oldSlots oldCounts memoryCounts

int memoryOf(int sphere)
{
    return inTextures ? int(oldSlotsAt(sphere)) : sphere;
}

uint memoryCountAt(int memory)
{
    return inTextures ? oldCountsAt(memory) : memoryCountsAt(memory);
}

bool remembersAt(int memory)
{
    return isActedOn(memoryCountAt(memory));
}
