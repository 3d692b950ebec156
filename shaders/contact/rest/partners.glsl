// The spheres that one has touched since before it came to rest.
#pragma reads memoryCounts partners slots
#include "contact/slots.glsl"

int rememberedBy(int sphere)
{
    return listedIn(memoryCountsAt(sphere));
}

// Returns the slot of the other sphere.
int partnerSlot(int sphere, int e)
{
    return int(slotsAt(int(partnersAt(sphere, e))));
}
