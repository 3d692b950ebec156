// The slots that touch something (contact/touch.glsl), a lane each.
layout(std430, binding = 3) readonly buffer Active {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint actives;
    uint dropped;
    uint activeSlots[];
};

// -1: no slot is this lane's.
int activeSlot()
{
    uint lane = gl_GlobalInvocationID.x;
    return lane < actives ? int(activeSlots[lane]) : -1;
}
