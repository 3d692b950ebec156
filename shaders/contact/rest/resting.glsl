// Whether the molecule of a slot's sphere rests and nothing has woken it in this step; without RESTING none does.
#include "contact/flags.glsl"
#ifdef RESTING
#pragma reads cells marks

bool rests(int slot)
{
    return hasFlag(cellsAt(slot).w) && !marksWoken(marksAt(slot));
}
#else
bool rests(int slot)
{
    return false;
}
#endif
