// How much of the sky clouds cover, and how bright they are, over the upper hemisphere as seen from its nadir
// (stereographic, render/sky_map.glsl). Drawn once: clouds stand still.

#include "physics/noise.glsl"
#include "render/sky_map.glsl"

in vec2 screen;

uniform float share;        // of the sky that is covered
uniform vec3 sunDirection;  // towards the sun, unit

out vec4 fragment;  // x: cover, y: light, both in [0, 1]

float thickness(vec2 point, int octaves)
{
    float sum = 0.0, weight = 0.5;
    // Large clouds are drawn out by shear; the small ones at their rims are not.
    vec2 place = point * vec2(0.75, 1.1);
    for (int i = 0; i < octaves; ++i) {
        sum += weight * gradientNoise(vec3(place, 0.37), uvec3(0u), 31u + uint(i));
        place = mat2(1.6, 1.2, -1.2, 1.6) * place;
        weight *= 0.52;
    }
    return sum + mix(-0.42, 0.35, share);
}

void main()
{
    vec3 direction = fromSkyMap(screen);
    if (direction.y <= 0.0) {
        fragment = vec4(0.0);
        return;
    }
    // The layer bends down with the earth, so that it ends at the horizon.
    vec2 point = direction.xz * (1.7 / (direction.y + 0.09));
    float here = thickness(point, 6);
    vec2 towards = sunDirection.xz / (max(sunDirection.y, 0.0) + 0.3);
    float before = thickness(point + 0.22 * towards, 4);
    float cover = smoothstep(0.0, 0.22, here);
    // Clouds between here and the sun shade this one; thin rims let light through.
    float light = exp(-2.2 * max(before, 0.0) - 1.1 * max(here, 0.0));
    fragment = vec4(cover * smoothstep(0.0, 0.16, direction.y), light, 0.0, 1.0);
}
