// What is behind everything.

#include "render/sky.glsl"
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
    fragment = vec4(squeeze(mix(ground, sky, smoothstep(-0.004, 0.004, direction.y))), 1.0);
}
