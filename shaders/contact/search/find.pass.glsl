// The spheres that each slot touches. Where molecules may rest (RESTING), of those that are awake, which mark what rests and is touched; then of
// what is marked (AMONG_RESTING).
#ifndef TEXTURES
#pragma updates counts lists
#endif
#ifdef RESTING
#include "contact/rest/marks.glsl"
#endif
#include "contact/search/search.glsl"

#ifdef AMONG_RESTING
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
#elif defined(RESTING)
#pragma reads awakeSlots

void main()
{
    bool isInside = gl_GlobalInvocationID.x < awake;
    int slot = int(awakeSlotsAt(int(min(gl_GlobalInvocationID.x, awake - 1u))));
    search(slot);
    if (isInside) finish(slot);
}
#elif defined(TEXTURES)
void main()
{
    int slot = ownLane();
    for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
    search(slot);
    finish(slot);
}
#else
void main()
{
    int slot = ownLane();
    search(slot);
    if (!isBehindLast()) finish(slot);
}
#endif
