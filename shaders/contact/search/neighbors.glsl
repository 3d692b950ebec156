// UberFlow's search (section 4.4): the spheres up to NEIGHBORS places before and behind one in the order of the keys are candidates. Those
// of its own cell that lie further, and those of most cells around it, are missed. With a second grid, moved by half a cell, its order adds to
// what the first has found.
#include "contact/search/touch.glsl"
#pragma reads staggered slots

// Nothing rests, which an awake sphere would mark (contact/rest/touch_resting.glsl).
void touchResting(int slot, vec3 d, float reach)
{
}

void look(int slot)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int other = slot + k;
        if (k != 0 && other >= 0 && other < count && isCandidate(other)) meet(other);
    }
}

// `place`: of the slot in the second grid.
void lookStaggered(int place)
{
    for (int k = -NEIGHBORS; k <= NEIGHBORS; ++k) {
        int beside = place + k;
        if (k != 0 && beside >= 0 && beside < count) {
            int other = int(slotsAt(int(staggeredAt(beside).y)));
            if (isCandidate(other) && !isListed(other)) meet(other);
        }
    }
}
