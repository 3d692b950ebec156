// UberFlow's search (section 4.4): a lane a place in the order of the keys; the spheres up to NEIGHBORS places before and
// behind it are candidates. Those of its own cell that lie further, and those of most cells around it, are missed.
// STAGGERED: the order of a second grid, moved by half a cell, adds to what the first has found.
#include "contact/records.glsl"
#include "contact/touch.glsl"

#ifdef STAGGERED
uniform usamplerBuffer staggered;  // by place: y its sphere
uniform usamplerBuffer slots;      // of a sphere
#endif

int slotAt(int place)
{
#ifdef STAGGERED
    return int(texelFetch(slots, int(texelFetch(staggered, place).y)).x);
#else
    return place;
#endif
}

bool listed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(lists[e * listStride + ownSlot]) == slot;
    return known;
}

void main()
{
    bool inside = int(gl_GlobalInvocationID.x) < count;
    int place = min(int(gl_GlobalInvocationID.x), count - 1);
    int slot = slotAt(place);
    loadOwn(slot);
#ifdef STAGGERED
    found = int(counts[slot] & CONTACTS);
#endif
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int at = place + k;
        if (inside && k != 0 && at >= 0 && at < count) {
            int other = slotAt(at);
            if (isCandidate(other)
#ifdef STAGGERED
                && !listed(other)
#endif
            )
                meet(other);
        }
    }
    if (inside) finish(slot);
}
