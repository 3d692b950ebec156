// The colour and alpha that a surface hands to the blending of the framebuffer. Set by C++: BLEND, one of these.
const int noneBlend = 0, alphaBlend = 1, additiveBlend = 2, multiplicativeBlend = 3;

uniform float opacity;

// `covered`: share of the pixel.
vec4 blended(vec3 light, vec3 albedo, float covered)
{
    if (BLEND == multiplicativeBlend) return vec4(mix(vec3(1.0), albedo, opacity * covered), 1.0);
    return vec4(light, BLEND == noneBlend ? covered : opacity * covered);
}
