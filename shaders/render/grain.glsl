// Grain that no image holds: relief and tone out of noise, from metres down to what a pixel still shows.

#include "physics/noise.glsl"

struct Grain {
    vec3 slope;  // of the relief along the axes of the mesh
    float tone;  // 0 where neither lighter nor darker
    vec3 tint;
    float openness;  // share of the sky that reaches the bottom of the relief
};

// One octave: its slope, and in w its value. It fades before it is finer than a pixel's footprint, m.
vec4 octave(vec3 p, vec3 stretch, float wavelength, float footprint, uint seed)
{
    float weight = 1.0 - smoothstep(0.25, 0.8, footprint / wavelength);
    if (weight <= 0.0) return vec4(0.0);
    vec3 scale = stretch / wavelength;
    return weight * vec4(scale, 1.0) * simplexNoiseSlope(p * scale, seed);
}

// `level`: how far the surface faces up, in [0, 1]. What does is mottled like grass and soil; what stands upright is
// furrowed like bark.
Grain earthGrain(vec3 p, float level, float footprint)
{
    vec3 stretch = mix(vec3(1.0, 0.13, 1.0), vec3(1.0), level);
    vec4 patches = octave(p, vec3(1.0), 2.6, footprint, 11u);
    vec4 tufts = octave(p, stretch, mix(0.09, 0.34, level), footprint, 12u);
    vec4 blades = octave(p, stretch, mix(0.035, 0.055, level), footprint, 13u);
    vec4 fine = octave(p, stretch, mix(0.015, 0.018, level), footprint, 14u);
    vec4 furrows = 0.7 * tufts + 0.7 * blades + 0.35 * fine;
    Grain grain;
    grain.slope = mix(0.012 * furrows, 0.03 * tufts + 0.014 * blades + 0.004 * fine, level).xyz;
    grain.tone = mix(0.9 * furrows, 0.3 * patches + 0.55 * tufts + 0.9 * blades + 0.8 * fine, level).w;
    grain.tint = mix(vec3(1.0), vec3(1.0 + 0.25 * patches.w, 1.0 + 0.05 * tufts.w, 1.0 - 0.3 * patches.w), level);
    grain.openness = 1.0 + 0.7 * mix(furrows, 0.5 * tufts + blades, level).w;
    return grain;
}

// Alike in all directions, pitted and stained.
Grain stoneGrain(vec3 p, float footprint)
{
    vec4 stains = octave(p, vec3(1.0), 0.9, footprint, 21u);
    vec4 lumps = octave(p, vec3(1.0), 0.21, footprint, 22u);
    vec4 pits = octave(p, vec3(1.0), 0.06, footprint, 23u);
    vec4 fine = octave(p, vec3(1.0), 0.017, footprint, 24u);
    vec4 relief = 0.035 * lumps + 0.014 * pits + 0.005 * fine;
    Grain grain;
    grain.slope = relief.xyz;
    grain.tone = 0.45 * stains.w + 0.4 * lumps.w + 0.5 * pits.w + 0.45 * fine.w;
    grain.tint = vec3(1.0 + 0.1 * stains.w, 1.0, 1.0 - 0.12 * stains.w);
    grain.openness = 1.0 + 0.6 * (0.6 * lumps.w + pits.w);
    return grain;
}
