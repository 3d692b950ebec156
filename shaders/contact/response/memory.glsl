// The memory that the last step has left of the contacts of a sphere: with buffers by sphere, so that a sphere that rests costs nothing; in fragments
// by the slot that it had.
#include "contact/slots.glsl"
#pragma reads oldSlots oldCounts oldLists partners slots
#pragma reads warmStart when buffers

int memoryOf(int sphere)
{
    return inTextures ? int(oldSlotsAt(sphere)) : sphere;
}

uint memoryCountAt(int memory)
{
    return inTextures ? oldCountsAt(memory) : floatBitsToUint(warmStartAt(memory).w);
}

bool remembersAt(int memory)
{
    return isActedOn(memoryCountAt(memory));
}

// Returns how many contacts it has.
int rememberedBy(int memory)
{
    return listedIn(memoryCountAt(memory));
}

// Returns the memory of the other sphere of a contact.
int partnerAt(int memory, int e)
{
    return int(inTextures ? oldListsAt(memory, e) : partnersAt(memory, e));
}

// Returns where a memory has the contact with the sphere of another, or -1.
int placeOf(int memory, int partner)
{
    int place = -1;
    for (int e = rememberedBy(memory) - 1; e >= 0; --e) place = partnerAt(memory, e) == partner ? e : place;
    return place;
}

// With buffers, the slot of that sphere.
int partnerSlot(int sphere, int e)
{
    return int(slotsAt(partnerAt(sphere, e)));
}
