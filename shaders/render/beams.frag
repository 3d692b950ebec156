// Beams of light through the water: how much more or less than its mean the light scattered towards the eye is, where
// the sun shines through the surface's waves. Drawn small: beams have no edges.

#include "render/sky.glsl"
#include "water/medium.glsl"

in vec2 screen;

uniform mat3 viewToScene;  // columns: right, up, towards the eye
uniform vec2 tangents;     // of half the field of view
uniform sampler2D sceneDepth;  // 1 - nearest / depth
uniform float nearest;         // m
uniform float strength;
uniform float reach;  // m

out vec4 fragment;

const int steps = 24;

void main()
{
    vec3 along = viewToScene * vec3((screen * 2.0 - 1.0) * tangents, -1.0);
    float stretch = length(along);
    vec3 direction = along / stretch;
    ivec2 texel = ivec2(screen * vec2(textureSize(sceneDepth, 0)));
    float depth = nearest / max(1.0 - texelFetch(sceneDepth, texel, 0).r, 1e-9);
    float way = min(depth * stretch, reach);
    if (direction.y > 0.0) way = min(way, max(eyeDepth, 0.0) / direction.y);
    float start = eyeDepth > 0.0 ? 0.0 : -eyeDepth / max(-direction.y, 1e-3);

    float step = max(way - start, 0.0) / float(steps);
    float mean = max(textureLod(caustics, vec2(0.5), 20.0).r, 1e-3);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < steps; ++i) {
        vec3 place = direction * (start + (float(i) + 0.5) * step);
        float below = max(depthOf(place), 0.0);
        // Beams come of the longer waves, and are told apart only nearby.
        float blur = 2.5 + 3.0 * min(length(place) / reach, 1.0);
        float net = textureLod(caustics, mat2(0.3, 0.1, -0.1, 0.3) * entryOf(place, below), blur).r;
        vec3 kept = exp(-waterExtinction * (length(place) - start + below / max(sunDirection.y, 0.2)));
        sum += kept * (net / mean - 1.0);
    }
    float forward = max(dot(direction, sunDirection), 0.0);
    float phase = 0.5 + 2.5 * pow(forward, 4.0);
    fragment = vec4(strength * phase * step * sum * waterScattering * 0.22, 1.0);
}
