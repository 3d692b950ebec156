// The spheres that each slot touches.
#include "contact/search/search.glsl"

// Nothing rests, which an awake sphere would mark (contact/rest/touch_resting.glsl).
void touchResting(int slot, vec3 d, float reach)
{
}

void main()
{
    int slot = ownLane();
    beginList();
    search(slot);
    if (!isBehindLast()) finish(slot);
}
