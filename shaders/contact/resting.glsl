// Whether the molecule of a slot's sphere rests and nothing has woken it in this step; without RESTING none does. Needs `cells`
// (contact/records.glsl).
#include "contact/flags.glsl"

#ifdef RESTING
uniform UINTS marks;  // by slot

bool rests(int slot)
{
    return (fetch(cells, slot).w & RESTS) != 0u && !marksWoken(fetch(marks, slot).x);
}
#else
bool rests(int slot)
{
    return false;
}
#endif
