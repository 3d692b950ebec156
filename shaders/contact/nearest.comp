// A lane a slot in contact: contact/nearest.glsl.
#include "contact/touching.glsl"
#include "contact/nearest.glsl"

layout(std430, binding = 0) writeonly buffer NewImpulses { vec4 newImpulses[]; };
layout(std430, binding = 2) writeonly buffer Shifts { vec4 shifts[]; };

void main()
{
    int taken = touchingSlot();
    int slot = max(taken, 0);
    Nearest response = respondToNearest(slot, taken < 0 ? 0 : listedOf(slot));
    if (taken >= 0) {
        newImpulses[slot] = vec4(response.impulse, 0.0);
        shifts[slot] = vec4(response.shift, 0.0);
    }
}
