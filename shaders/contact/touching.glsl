// The slots that take part in the response (RESPONDS in contact/flags.glsl), in no particular order: no lane depends on another.
layout(std430) buffer Touching {
    uint touching;
    uint touchingSlots[];
};

// -1: no slot is this lane's.
int touchingSlot()
{
    uint lane = gl_GlobalInvocationID.x;
    return lane < touching ? int(touchingSlots[lane]) : -1;
}

// Where an entry of this lane's slot lies in what only the response keeps of it, close together whether many touch or few.
#define OWN_ENTRY(e) ((e) * listStride + int(gl_GlobalInvocationID.x))
