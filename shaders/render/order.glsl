// The order in which molecules are drawn: x key, y molecule (src/render/draw_order.h). Variants: ORDER_BUFFER,
// ORDER_PAIRED (two pairs a texel).
#ifdef ORDER_BUFFER
uniform usamplerBuffer order;

uvec2 orderAt(int i)
{
    return texelFetch(order, i).xy;
}
#else
uniform usampler2D order;

uvec2 orderAt(int i)
{
    int width = textureSize(order, 0).x;
#ifdef ORDER_PAIRED
    int t = i / 2;
    uvec4 two = texelFetch(order, ivec2(t % width, t / width), 0);
    return (i & 1) == 0 ? two.xy : two.zw;
#else
    return texelFetch(order, ivec2(i % width, i / width), 0).xy;
#endif
}
#endif

// The first place of `count` whose key is not below.
int placeOf(uint key, int count)
{
    int low = 0, high = count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (orderAt(middle).x < key) low = middle + 1;
        else high = middle;
    }
    return low;
}
