// The sphere whose slot a pass writes; -1: the texel is past the last.
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform int count;

int ownSphere()
{
    int slot = ownNumber();
    return slot < count ? int(pairAt(sorted, slot).y) : -1;
}
