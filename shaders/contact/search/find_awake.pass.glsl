// The spheres that each slot which is awake touches; it marks what rests and is touched.
#include "contact/rest/touch_resting.glsl"
#include "contact/search/search.glsl"
#pragma reads awakeSlots

void main()
{
    bool isInside = gl_GlobalInvocationID.x < awake;
    int slot = int(awakeSlotsAt(int(min(gl_GlobalInvocationID.x, awake - 1u))));
    search(slot);
    if (isInside) finish(slot);
}
