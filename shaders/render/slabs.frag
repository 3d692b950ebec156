// Cuts the depths into slabs that hold about as many molecules each of the group whose order is read: texel s
// has the first key of slab s and the first one past it. The first slab lies behind all of that group, the
// last begins at its nearest. Slabs adjoin without a gap, also where the order is not quite sorted.
#include "render/order.glsl"

uniform int moleculeCount, slabCount;

layout(location = 0) out uvec2 bounds;

uint firstKey(int slab, int count)
{
    if (slab == 0) return 0u;
    if (slab == slabCount) return 0xffffffffu;
    uint key = 0u;
    for (int s = 1; s <= slab; ++s) {
        float share = slabCount > 2 ? float(s - 1) / float(slabCount - 2) : 0.5;
        float position = share * float(count - 1);
        int i = min(int(position), count - 1);
        uint here = orderAt(i).x, next = max(orderAt(min(i + 1, count - 1)).x, here);
        key = max(key, here + uint(float(next - here) * (position - float(i))));
    }
    return key;
}

void main()
{
    int s = int(gl_FragCoord.x);
    int count = max(placeOf(0xffffffffu, moleculeCount), 1);  // of the living: the dead come last
    bounds = uvec2(firstKey(s, count), firstKey(s + 1, count));
}
