// The colour of a molecule. With COLOR_BY by its speed; else no two leaves of a tree are alike: each instance takes its place
// between two colours from its seed. Needs state/molecule.glsl.
#ifdef COLOR_BY
#include "render/color_scale.glsl"

vec3 instanceColor(int molecule)
{
    return scaleColor(molecule);
}
#else
#include "physics/random.glsl"

uniform vec3 firstColor;  // linear RGB
uniform vec3 secondColor;

vec3 instanceColor(int molecule)
{
    uint seed = moleculeSeed(molecule);
    float between = uniformFrom(hashSeed(seed, 0xc0101u));
    float brightness = uniformFrom(hashSeed(seed, 0xc0102u));
    // Most are near the first colour, a few well on their way to the second.
    return mix(firstColor, secondColor, between * between * (1.5 - 0.5 * between)) * (0.8 + 0.4 * brightness);
}
#endif
