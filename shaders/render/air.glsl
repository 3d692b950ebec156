// Air around the eye and all else, with haze: what light loses and gains on its way. Places are relative to the eye.
// water/medium.glsl has the same functions.
#include "render/sky.glsl"

uniform float fogDensity;  // 1/m

bool isHazy()
{
    return fogDensity > 0.0;
}

// Sunlight that arrives, of a surface's radiance.
vec3 sunlightAt(vec3 place)
{
    return sunColor;
}

// Light from all around onto a surface, divided by pi.
vec3 ambientAt(vec3 place, vec3 normal)
{
    return ambientLight(normal);
}

// Returns the radiance that a mirror reflects to the eye from a direction.
vec3 mirroredFrom(vec3 place, vec3 direction, float roughness)
{
    return mirroredInAir(direction, roughness);
}

// Share of the light from a place that reaches the eye.
vec3 hazeThrough(vec3 place)
{
    return vec3(exp(-fogDensity * length(place)));
}

vec3 withHaze(vec3 radiance, vec3 place)
{
    float distance = length(place);
    return mix(hazeColor(place / max(distance, 1e-4)), radiance, exp(-fogDensity * distance));
}

// Returns the colour that distant things fade into.
vec3 farColor(vec3 direction)
{
    return hazeColor(direction);
}
