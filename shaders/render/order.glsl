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
