// render/order_keys.comp as a fragment pass: numbers the molecules of a group, or keeps the order that there
// is, and gives them their keys. Texels as src/sort/network_sort.h has them.
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

layout(location = 0) out uvec4 pairs;  // a texel of one pair takes the first

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    int i = texel.y * textureSize(order, 0).x + texel.x;
    pairs = ORDER_PAIRED ? uvec4(pairAt(2 * i), pairAt(2 * i + 1)) : uvec4(pairAt(i), 0u, 0u);
}
