// How contact, schools and births read what they keep, all of it by one number: from buffers, or with TEXTURES (OpenGL 3.3) from
// textures in rows of 2^ROW_BITS texels. Written as macros because a texel is fetched from either in the same words but not
// with the same types.
#ifdef TEXTURES
const bool inTextures = true;
#define UINTS usampler2D
#define FLOATS sampler2D
#define fetch(values, i) texelFetch(values, texelOf(i), 0)

ivec2 texelOf(int i)
{
    return ivec2(i & ((1 << ROW_BITS) - 1), i >> ROW_BITS);
}

// The number of the texel that the pass writes.
#define ownNumber() numberOf(ivec2(gl_FragCoord.xy))

int numberOf(ivec2 texel)
{
    return (texel.y << ROW_BITS) + texel.x;
}
#else
const bool inTextures = false;
#define UINTS usamplerBuffer
#define FLOATS samplerBuffer
#define fetch(values, i) texelFetch(values, i)
#endif
