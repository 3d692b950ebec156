// The spheres that each slot touches: all of them. Where molecules may rest (MARKS) a lane has a slot that is awake, which marks what rests
// and is touched; then, with MARKED, a marked one, whose molecule rests.
//
// Cells are twice as wide as the way to a sphere that one may touch, two diameters or more, so that of the 27 around a sphere only the eight
// on its side can hold one.
//
// A rasteriser on a CPU runs both sides of a branch, but leaves a loop when no lane stays in it: what is rare is the body
// of a loop here, and the eight cells are one loop.
#include "contact/search/touch.glsl"
#pragma reads starts

uniform float reach;  // m, no more than half a cell: what is further away touches nothing

int startOf(int key)
{
    return inTextures && key > keyMask ? count : int(startsAt(key));
}

// Returns cell c of the eight to search: bit a of c selects the one further along axis a.
ivec3 cellBeside(ivec3 side, int c)
{
    return ownCell + side * ivec3(c & 1, (c >> 1) & 1, c >> 2);
}

// AHEAD candidates are fetched at once (set by C++): a GPU waits as long for some as for one.

// Candidate i of cell c, with ends[c - 1] <= i < ends[c], is in slot i + shifts[c].
int shifts[8];
int ends[8];

int slotOf(int i)
{
    int shift = shifts[7];
    for (int c = 6; c >= 0; --c) shift = i < ends[c] ? shifts[c] : shift;
    return i + shift;
}

void search(int slot)
{
    loadOwn(slot);
    vec3 offset = ownPlace - vec3(ownCell & (localCells - 1)) * cell;
    ivec3 side = ivec3(step(vec3(0.5 * cell), offset)) * 2 - 1;
    int sum = 0;
    for (int c = 0; c < 8; ++c) {
        int key = int(cellKey(cellBeside(side, c), uint(keyMask)));
        int first = startOf(key);
        shifts[c] = first - sum;
        sum += startOf(key + 1) - first;
        ends[c] = sum;
    }
    float reachSquared = reach * reach;
    int i = 0;  // the next candidate
    while (i < sum) {
        bool hit = false;
        int other = 0;
        while (i < sum && !hit) {
            int others[AHEAD];
            uvec4 theirs[AHEAD];
            for (int k = 0; k < AHEAD; ++k) {
                others[k] = slotOf(min(i + k, sum - 1));
                theirs[k] = placesAt(others[k]);
            }
            int next = i + AHEAD;
            for (int k = AHEAD - 1; k >= 0; --k) {
                vec3 d = localDifference(ownPlace, uintBitsToFloat(theirs[k].xyz), cell);
                if (i + k < sum && dot(d, d) < reachSquared && mayMeet(theirs[k].w, others[k])) {
                    hit = true;
                    other = others[k];
                    next = i + k + 1;
                }
            }
            i = next;
        }
        while (hit) {
            // cells may share keys, and places repeat
            int c = 0;
            for (int k = 0; k < 7; ++k) c += int(i > ends[k]);
            if (cellOf(other) == cellBeside(side, c)) meet(other);
            hit = false;
        }
    }
}

#ifdef MARKED
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
#elif defined(MARKS)
#pragma reads awakeSlots

void main()
{
    bool isInside = gl_GlobalInvocationID.x < awake;
    int slot = int(awakeSlotsAt(int(min(gl_GlobalInvocationID.x, awake - 1u))));
    search(slot);
    if (isInside) finish(slot);
}
#else
void main()
{
    int slot = ownLane();
    search(slot);
    if (!isBehindLast()) finish(slot);
}
#endif
