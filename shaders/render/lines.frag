// Lines that show how things work: by their own light, whatever the sun does.

#include "render/tone.glsl"

in vec3 color;

out vec4 fragment;

void main()
{
    fragment = vec4(squeeze(color), 1.0);
}
