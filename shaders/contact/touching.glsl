// The slots that touch something, in no particular order: what is done for each depends on nothing but itself.
layout(std430, binding = 5) buffer Touching {
    uint touching;
    uint touchingSlots[];
};
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

// -1: no slot is this lane's.
int touchingSlot()
{
    uint lane = gl_GlobalInvocationID.x;
    return lane < touching ? int(touchingSlots[lane]) : -1;
}

// Where an entry of this lane's slot lies in what only the response keeps of it, close together whether many touch or few.
#define OWN_ENTRY(e) ((e) * listStride + int(gl_GlobalInvocationID.x))
