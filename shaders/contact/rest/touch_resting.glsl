// An awake sphere marks the resting ones that it touches.
#include "contact/rest/marks.glsl"
#include "contact/search/touch.glsl"

void touchResting(int slot, vec3 d, float reach)
{
    if (rested(searching) || !rested(slot)) return;
    bool struck = haveMet(d, reach, slot);
    mark(slot, struck ? TOUCHED | STRUCK : TOUCHED);
    if (struck) struckX = uint(count + 63) / 64u;
}
