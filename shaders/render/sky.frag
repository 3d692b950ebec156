// Draws the background, behind everything else. Variant: WATER. Set by C++, true or false: CLOUDS.

#include "render/sky.glsl"
#include "render/sky_map.glsl"
#ifdef WATER
#include "water/medium.glsl"
#include "water/surface.glsl"
#endif
#include "render/tone.glsl"

in vec2 screen;

uniform mat3 viewToScene;   // columns: right, up, towards the eye
uniform vec2 tangents;      // of half the field of view, horizontal and vertical
uniform sampler2D clouds;   // render/clouds.frag

out vec4 fragment;

void main()
{
    vec3 direction = normalize(viewToScene * vec3((screen * 2.0 - 1.0) * tangents, -1.0));
    vec3 sky = skyGradient(direction) + sunGlow(direction) + sunDisc(direction);
    if (CLOUDS && direction.y > 0.0) {
        vec4 cloud = textureLod(clouds, onSkyMap(direction), 0.0);
        // Lit by the sun above and by the sky below, and through its rim where the sun is behind it.
        vec3 white = sunColor * (0.3 * cloud.y + 0.25 * cloud.y * pow(max(dot(direction, sunDirection), 0.0), 8.0)) +
                     0.75 * mix(skyHorizon, skyZenith, 0.35);
        sky = mix(sky, mix(hazeColor(direction), white, smoothstep(0.0, 0.25, direction.y)), 0.95 * cloud.x);
    }
    // Below the horizon: haze, then ground.
    vec3 ground = mix(hazeColor(direction), skyGround, smoothstep(0.0, 0.35, -direction.y));
#ifdef WATER
    if (eyeDepth > 0.0) {
        fragment = vec4(squeeze(fromBelow(direction)), 1.0);
        return;
    }
    ground = farColor(direction);
#endif
    fragment = vec4(squeeze(mix(ground, sky, smoothstep(-0.004, 0.004, direction.y))), 1.0);
}
