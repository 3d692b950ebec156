// The resolved light as a picture for the screen: exposure, film curve, sRGB, and a little dither, which keeps
// the sky's gradient free of bands. Variant: BEAMS (water/rays.frag).

#include "physics/random.glsl"
#include "render/tone.glsl"

in vec2 screen;

uniform sampler2D light;
uniform float exposure;
#ifdef BEAMS
uniform sampler2D beams;
#endif

out vec4 fragment;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 radiance = unsqueeze(texelFetch(light, pixel, 0).rgb);
#ifdef BEAMS
    radiance = max(radiance + texture(beams, screen).rgb, 0.25 * radiance);
#endif
    radiance *= exposure;
    // Half floats hold no more than this: light that was added up beyond it has become infinite, and what was blended
    // over that no number at all.
    const float brightest = 6e4;
    radiance = mix(min(radiance, vec3(brightest)), vec3(brightest), isnan(radiance));
    vec3 shown = encodeSrgb(toneMap(radiance));
    float dither = uniformFrom(hashSeed(uint(pixel.x), uint(pixel.y))) - 0.5;
    fragment = vec4(shown + dither / 255.0, 1.0);
}
