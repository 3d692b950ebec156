// The slots that take part in the response (RESPONDS in contact/flags.glsl). With buffers they are a list in no particular order, and a lane
// has one; in fragments each texel looks at its own slot.
#include "state/lanes.glsl"
#include "contact/flags.glsl"
#ifdef TEXTURES
#pragma reads counts

// The slot of this texel. Others than those that respond are left as they are.
int ownSlot(int count)
{
    int slot = ownNumber();
    if (slot >= count || countsAt(slot) == 0u) discard;
    return slot;
}

int ownRow(int slot)
{
    return slot;
}
#else
#pragma reads responding

// The slot of this lane, or -1.
int ownSlot(int count)
{
    int lane = int(gl_GlobalInvocationID.x);
    return lane < int(respondingAt(0)) ? int(respondingAt(1 + lane)) : -1;
}

// Where the response keeps what it knows of the contacts of this lane's slot: close together whether many respond or few.
int ownRow(int slot)
{
    return int(gl_GlobalInvocationID.x);
}
#endif
