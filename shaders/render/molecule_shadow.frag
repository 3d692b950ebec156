// Depth of molecules as the sun sees them, leaves cut out. Variant: TEXTURED.

#ifdef TEXTURED
#include "render/alpha_cut.glsl"
#endif

in vec2 uv;

void main()
{
#ifdef TEXTURED
    if (keptAlpha(texture(image, uv).a, uv) < alphaCut) discard;
#endif
}
