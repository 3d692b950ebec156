// A texel a slot: places, velocities and speeds in the order of the sorted keys.
#include "school/order.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform int count;

layout(location = 0) out vec4 newPlace;
layout(location = 1) out vec4 newVelocity;

void main()
{
    int slot = ownNumber();
    if (slot >= count) discard;
    int body = int(pairAt(sorted, slot).y);
    newPlace = placeOf(body);
    newVelocity = velocityOf(body);
}
