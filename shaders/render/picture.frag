// The resolved light as a picture for the screen: exposure, film curve, sRGB, and a little dither, which keeps
// the sky's gradient free of bands. Set by C++, true or false: BEAMS (render/beams.frag), OCCLUSION
// (render/occlusion.frag); CLEAR, whose light is multiplied by its alpha, the share of the pixel that is covered, and whose
// picture is not; LINEAR, light as it is for a compositor, multiplied by alpha.

#include "physics/random.glsl"
#include "render/occlusion.glsl"
#include "render/tone.glsl"

in vec2 screen;

uniform sampler2D light;
uniform float exposure;
uniform sampler2D beams;
uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform float occlusionStrength, ambientLuminance;

out vec4 fragment;

// The light without that of the sky which does not reach the place. What is brighter than the sky can make it is lit by
// the sun as well.
vec3 occluded(vec3 radiance, ivec2 pixel)
{
    float stored = texture(sceneDepth, screen).r;
    if (stored >= 1.0) return radiance;
    float seen = skySeen(pixel, nearest / (1.0 - stored));
    float luminance = dot(radiance, vec3(0.2126, 0.7152, 0.0722));
    float ofSky = clamp(ambientLuminance / max(luminance, 1e-6), 0.45, 1.0);
    return radiance * (1.0 - occlusionStrength * ofSky * (1.0 - seen));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 stored = texelFetch(light, pixel, 0);
    float alpha = CLEAR ? clamp(stored.a, 0.0, 1.0) : 1.0;
    vec3 radiance = unsqueeze(stored.rgb / max(alpha, 1e-4));
    if (OCCLUSION && occlusionStrength > 0.0) radiance = occluded(radiance, pixel);
    if (BEAMS) radiance = max(radiance + texture(beams, screen).rgb, 0.25 * radiance);
    radiance *= exposure;
    // Half floats hold no more than this: light that was added up beyond it has become infinite, and what was blended
    // over that no number at all.
    const float brightest = 6e4;
    radiance = mix(min(radiance, vec3(brightest)), vec3(brightest), isnan(radiance));
    if (LINEAR) {
        fragment = vec4(radiance * alpha, alpha);
        return;
    }
    vec3 shown = encodeSrgb(toneMap(radiance));
    float dither = uniformFrom(hashSeed(uint(pixel.x), uint(pixel.y))) - 0.5;
    fragment = vec4(alpha > 0.0 ? shown + dither / 255.0 : vec3(0.0), alpha);
}
