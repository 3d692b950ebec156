// The slots that take part in the response (RESPONDS in contact/flags.glsl). With buffers they are a list in no particular order, and a lane
// has one; in fragments each texel looks at its own slot.
#include "state/lanes.glsl"
#include "contact/flags.glsl"
#pragma reads counts responding

// The slot of this lane, or -1. Texels of slots that do not respond are left as they are.
int ownSlot(int count)
{
    int number = ownNumber();
    if (!inTextures) return number < int(respondingAt(0, 0)) ? int(respondingAt(1 + number, 0)) : -1;
    if (number >= count || countsAt(number) == 0u) discardTexel();
    return number;
}

// Where the response keeps what it knows of a slot that takes part: with buffers close together, whether many do or few.
// What rests has none (NO_ROW), nor has an awake slot that takes no part, of which nobody asks.
int rowOf(int slot)
{
    return inTextures ? slot : int(respondingAt(1 + slot, 1));
}

// The row of this lane's slot.
int ownRow(int slot)
{
    return inTextures ? slot : ownNumber();
}
