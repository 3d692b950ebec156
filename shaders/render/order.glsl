// The order in which molecules are drawn: x key, y molecule (src/render/draw_order.h), in a buffer (ORDER_BUFFER) or in a
// texture, where ORDER_PAIRED is true with two pairs a texel.
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
    int t = ORDER_PAIRED ? i / 2 : i;
    uvec4 pairs = texelFetch(order, ivec2(t % width, t / width), 0);
    return ORDER_PAIRED && (i & 1) != 0 ? pairs.zw : pairs.xy;
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
