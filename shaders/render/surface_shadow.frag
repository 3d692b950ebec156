// Depth only. Set by C++, true or false: HOLES, of the colour image, whose alpha counts; BLENDED, by opacity, else what has
// holes is cut out.

uniform vec4 meshColor;   // a opacity
uniform sampler2D image;  // a opacity
uniform float alphaCut;

in vec2 uv;

// As many of the texels as it hides of the light, evenly spread; the shadow map's filter averages them [Jimenez 2014].
float spreadOpacity()
{
    return fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
}

void main()
{
    float opacity = meshColor.a;
    if (HOLES) opacity *= texture(image, uv).a;
    float least = BLENDED ? spreadOpacity() : alphaCut;
    if ((HOLES || BLENDED) && opacity < least) discard;
}
