// The memory that the last step has left of the contacts of a sphere: with buffers by sphere, so that a sphere that rests costs nothing; in fragments
// by the slot that it had.
#include "contact/slots.glsl"
#ifdef TEXTURES
#pragma reads oldSlots oldCounts

int memoryOf(int sphere)
{
    return int(oldSlotsAt(sphere));
}

uint memoryCountAt(int memory)
{
    return oldCountsAt(memory);
}
#else
#pragma reads memoryCounts

int memoryOf(int sphere)
{
    return sphere;
}

uint memoryCountAt(int memory)
{
    return memoryCountsAt(memory);
}
#endif

bool remembersAt(int memory)
{
    return isActedOn(memoryCountAt(memory));
}
