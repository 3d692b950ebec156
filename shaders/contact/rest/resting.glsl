#include "contact/flags.glsl"
#pragma reads cells marks

// Whether the molecule of a slot's sphere rests and nothing has woken it in this step; without RESTS none does.
bool rests(int slot)
{
    return RESTS && hasFlag(cellsAt(slot).w) && !marksWoken(marksAt(slot));
}
