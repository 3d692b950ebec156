// The colour of a molecule. With COLOR_BY by its speed; else no two leaves of a tree are alike: each instance takes its place
// between two colours from its seed.
#include "state/molecule.glsl"
#ifdef COLOR_BY
#include "render/color_scale.glsl"

vec3 instanceColor(int molecule)
{
    return scaleColor(molecule);
}
#else
#include "render/looks.glsl"

uniform vec3 firstColor;  // linear RGB
uniform vec3 secondColor;
uniform float variation;  // of the brightness, in [0, 1]

vec3 instanceColor(int molecule)
{
    return colorOfSeed(moleculeSeed(molecule), firstColor, secondColor, variation);
}
#endif
