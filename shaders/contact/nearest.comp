// A lane a slot in contact: contact/nearest.glsl.
#include "contact/touching.glsl"
#include "contact/nearest.glsl"

layout(std430) writeonly buffer Totals { vec4 newTotals[]; };

void main()
{
    int taken = touchingSlot();
    int slot = max(taken, 0);
    Nearest response = respondToNearest(slot, taken < 0 ? 0 : listedOf(slot));
    if (taken >= 0) {
        newTotals[2 * slot] = vec4(response.impulse, 0.0);
        newTotals[2 * slot + 1] = vec4(response.shift, 0.0);
    }
}
