// Whether the molecule of a slot's sphere rests, which without RESTING none does.
#ifdef RESTING
#include "contact/flags.glsl"

uniform usamplerBuffer cells;  // by slot (contact/records.glsl)
uniform usamplerBuffer marks;  // by slot

bool rests(int slot)
{
    return isResting(texelFetch(cells, slot).w, texelFetch(marks, slot).x);
}
#else
bool rests(int slot)
{
    return false;
}
#endif
