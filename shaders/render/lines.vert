// Lines of given colours.

layout(location = 0) in vec3 place;  // m, relative to the eye
layout(location = 1) in vec3 light;  // linear RGB

uniform mat4 toClip;

out vec3 color;

void main()
{
    color = light;
    gl_Position = toClip * vec4(place, 1.0);
}
