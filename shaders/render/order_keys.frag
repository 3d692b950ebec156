// render/order_keys.comp as a fragment pass: numbers the molecules of a group, or keeps the order that there
// is, and gives them their keys. Texels as src/sort/network_sort.h has them. Variant: ORDER_PAIRED.
#include "render/order_key.glsl"
#include "render/order.glsl"

uniform bool keepOrder;

uvec2 pairAt(int i)
{
    int molecule = i;
    if (keepOrder) molecule = int(orderAt(i).y);
    molecule = min(molecule, moleculeCount - 1);  // past the last: kept out of the sort
    return uvec2(orderKey(molecule), uint(molecule));
}

#ifdef ORDER_PAIRED
layout(location = 0) out uvec4 pairs;
#else
layout(location = 0) out uvec2 pairs;
#endif

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    int i = texel.y * textureSize(order, 0).x + texel.x;
#ifdef ORDER_PAIRED
    pairs = uvec4(pairAt(2 * i), pairAt(2 * i + 1));
#else
    pairs = pairAt(i);
#endif
}
