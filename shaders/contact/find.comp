// A lane a slot: the list of the spheres that it touches. Where molecules may rest (RESTING), of those that are awake, which mark
// what rests and is touched; then of what is marked (AMONG_RESTING).
#include "contact/search.glsl"

#ifdef AMONG_RESTING
#include "contact/recalled.glsl"

// A molecule that an impact further away has woken has not moved yet: it touches what it did.
void recall(int slot)
{
    ownSlot = slot;
    int sphere = sphereOf(slot);
    found = oldCount(sphere);
    for (int e = 0; e < found; ++e) lists[e * listStride + slot] = uint(oldPartner(sphere, e));
}

void main()
{
    if (gl_GlobalInvocationID.x >= marked) return;
    int slot = int(markedSlots[gl_GlobalInvocationID.x]);
    bool touched = (marks[slot] & TOUCHED) != 0u || marks[slot] == BESIDE;
    if (touched) search(slot);
    if (!touched) recall(slot);
    if (marksWoken(marks[slot])) finish(slot);
    if (!marksWoken(marks[slot])) counts[slot] = uint(found);  // to contact/weigh.comp
}
#elif defined(RESTING)
uniform usamplerBuffer awakeSlots;

void main()
{
    bool inside = gl_GlobalInvocationID.x < awake;
    int slot = int(texelFetch(awakeSlots, int(min(gl_GlobalInvocationID.x, awake - 1u))).x);
    search(slot);
    if (inside) finish(slot);
}
#else
void main()
{
    bool inside = int(gl_GlobalInvocationID.x) < count;
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    search(slot);
    if (inside) finish(slot);
}
#endif
