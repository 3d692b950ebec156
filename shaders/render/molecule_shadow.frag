// Depth of molecules as the sun sees them, leaves cut out. Set by C++, true or false: TEXTURED.

#include "render/alpha_cut.glsl"

in vec2 uv;

void main()
{
    if (TEXTURED && keptAlpha(texture(image, uv).a, uv) < alphaCut) discard;
}
