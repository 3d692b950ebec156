// The spheres that each marked slot touches, whose molecule rests (contact/search/find_awake.pass.glsl has marked it).
#include "contact/rest/touch_resting.glsl"
#include "contact/search/search.glsl"
#include "contact/rest/partners.glsl"

// A molecule that an impact further away has woken has not moved yet: it touches what it did.
void recall(int slot)
{
    loadOwn(slot);
    int sphere = sphereOf(slot);
    found = rememberedBy(sphere);
    for (int e = 0; e < found; ++e) putLists(slot, e, uint(partnerSlot(sphere, e)));
}

void main()
{
    if (gl_GlobalInvocationID.x >= marked) return;
    int slot = int(markedSlotsAt(int(gl_GlobalInvocationID.x)));
    bool touched = (marksAt(slot) & TOUCHED) != 0u || marksAt(slot) == BESIDE;
    if (touched) search(slot);
    if (!touched) recall(slot);
    if (marksWoken(marksAt(slot))) finish(slot);
    if (!marksWoken(marksAt(slot))) putCounts(slot, uint(found));  // to contact/rest/load_change.pass.glsl
}
