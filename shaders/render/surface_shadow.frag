// Depth only. Variants: HOLES, of the colour image, whose alpha counts; BLENDED, by opacity, else what has holes is cut
// out.

#if defined(HOLES) || defined(BLENDED)
uniform vec4 meshColor;  // a opacity
#ifdef HOLES
uniform sampler2D image;  // a opacity

in vec2 uv;
#endif
#ifdef BLENDED
// As many of the texels as it hides of the light, evenly spread; the shadow map's filter averages them [Jimenez 2014].
float leastOpacity()
{
    return fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
}
#else
uniform float alphaCut;

float leastOpacity()
{
    return alphaCut;
}
#endif
#endif

void main()
{
#if defined(HOLES) || defined(BLENDED)
    float opacity = meshColor.a;
#ifdef HOLES
    opacity *= texture(image, uv).a;
#endif
    if (opacity < leastOpacity()) discard;
#endif
}
