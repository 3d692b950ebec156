// The colour of a molecule. No two leaves of a tree are alike: each instance takes its place between two colours from its
// seed. Set by C++, true or false: COLOR_BY, its speed says the colour instead.
#include "render/color_scale.glsl"
#include "render/looks.glsl"
#include "state/molecule.glsl"

uniform vec3 firstColor;  // linear RGB
uniform vec3 secondColor;
uniform float variation;  // of the brightness, in [0, 1]

vec3 instanceColor(int molecule)
{
    if (COLOR_BY) return scaleColor(molecule);
    return colorOfSeed(moleculeSeed(molecule), firstColor, secondColor, variation);
}
