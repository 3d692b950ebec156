// The bodies that school/body.glsl has found, by their numbers.
#include "state/numbered.glsl"

#ifdef TEXTURES
uniform sampler2DArray bodies;

vec4 bodyElement(int body, int e)
{
    return texelFetch(bodies, ivec3(texelOf(body), e), 0);
}
#else
uniform samplerBuffer bodies;

vec4 bodyElement(int body, int e)
{
    return texelFetch(bodies, BODY_ELEMENTS * body + e);
}
#endif
