// Draws the background, behind everything else. Variant: WATER.

#include "render/sky.glsl"
#ifdef WATER
#include "water/medium.glsl"
#include "water/surface.glsl"
#endif
#include "render/tone.glsl"

in vec2 screen;

uniform mat3 viewToScene;   // columns: right, up, towards the eye
uniform vec2 tangents;      // of half the field of view, horizontal and vertical

out vec4 fragment;

void main()
{
    vec3 direction = normalize(viewToScene * vec3((screen * 2.0 - 1.0) * tangents, -1.0));
    vec3 sky = skyGradient(direction) + sunGlow(direction) + sunDisc(direction);
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
