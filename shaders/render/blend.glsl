// The colour and alpha that a surface hands to the blending of the framebuffer. Variants: BLENDED, FILTERS
// (multiplicative).
#ifdef BLENDED
uniform float opacity;
#endif

// `covered`: share of the pixel.
vec4 blended(vec3 light, vec3 albedo, float covered)
{
#ifdef FILTERS
    return vec4(mix(vec3(1.0), albedo, opacity * covered), 1.0);
#elif defined(BLENDED)
    return vec4(light, opacity * covered);
#else
    return vec4(light, covered);
#endif
}
