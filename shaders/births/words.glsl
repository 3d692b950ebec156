// How fragments and vertices read lists of words, in rows of STATE_WIDTH texels, and the words of control, a row of texels
// of four a group.
#include "births/control.glsl"

uint wordAt(usampler2D list, int i)
{
    return texelFetch(list, ivec2(i % STATE_WIDTH, i / STATE_WIDTH), 0).x;
}

uint wordOfControl(usampler2D control, int w)
{
    uvec4 four = texelFetch(control, ivec2((w % controlWords) / 4, w / controlWords), 0);
    return four[w % 4];
}
