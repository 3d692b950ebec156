// Depth only. Variant: CUT, out of the colour image by its alpha.

#ifdef CUT
#include "render/alpha_cut.glsl"

uniform vec4 meshColor;  // a opacity

in vec2 uv;
#endif

void main()
{
#ifdef CUT
    if (meshColor.a * texture(image, uv).a < alphaCut) discard;
#endif
}
