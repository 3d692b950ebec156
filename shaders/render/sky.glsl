// The sky's light by direction: a gradient from the horizon to the zenith, brighter around the sun.

uniform vec3 skyZenith;  // radiance, linear RGB
uniform vec3 skyHorizon;
uniform vec3 skyGround;
uniform vec3 sunDirection;  // towards the sun, unit
uniform vec3 sunColor;      // radiance of a white surface that faces the sun
uniform vec3 ambientAbove;  // light onto a surface that faces up, divided by pi, and down
uniform vec3 ambientBelow;

// The sky's colours are given as a picture shows them; next to full sunlight a clear sky is this much brighter.
const float skyBrightness = 1.55;

vec3 skyGradient(vec3 direction)
{
    float height = max(direction.y, 0.0);
    // The air is thickest near the horizon: the gradient is steep there and flat above.
    return skyBrightness * mix(skyHorizon, skyZenith, 1.0 - exp(-4.5 * height));
}

// Light scattered forward by haze around the sun.
vec3 sunGlow(vec3 direction)
{
    float towards = max(dot(direction, sunDirection), 0.0);
    float power2 = towards * towards;
    float power6 = power2 * power2 * power2;
    float power12 = power6 * power6;
    float power36 = power12 * power12 * power12;
    return sunColor * (0.05 * power6 + 0.12 * power36 * power36 * power12 * power6);
}

vec3 sunDisc(vec3 direction)
{
    // Drawn at twice the real 0.27 degrees, as a camera's bloom would have it.
    return sunColor * 12.0 * smoothstep(0.99992, 0.99997, dot(direction, sunDirection));
}

// Returns the colour that distant things fade into along a direction: the sky just above the horizon.
vec3 hazeColor(vec3 direction)
{
    vec3 level = normalize(vec3(direction.x, max(direction.y, 0.0) * 0.5 + 0.01, direction.z));
    return skyGradient(level) + sunGlow(level);
}

// Light from all around onto a surface with this normal, divided by pi: the sky above, the ground below.
vec3 ambientLight(vec3 normal)
{
    return mix(ambientBelow, ambientAbove, 0.5 + 0.5 * normal.y);
}

// Returns the radiance that a mirror reflects from a direction.
vec3 mirroredInAir(vec3 direction, float roughness)
{
    return mix(ambientLight(vec3(0.0, -1.0, 0.0)), skyGradient(direction) + sunGlow(direction),
               smoothstep(-0.05 - roughness, 0.05 + roughness, direction.y));
}
