// A triangle mesh of the scene: host models, terrain, colliders.

layout(location = 0) in vec3 corner;  // m, relative to the mesh's own origin
layout(location = 1) in vec3 cornerNormal;
layout(location = 2) in vec3 cornerColor;
layout(location = 3) in vec2 cornerUv;

uniform mat4 toClip;
uniform vec3 meshOrigin;  // relative to the origin of drawing, m
uniform float meshScale;
uniform mat3 meshTurn;
uniform vec3 grainOffset;  // of the mesh in the procedural grain, m

out vec2 uv;
out vec3 place;
out vec3 local;
out vec3 normal;
out vec3 color;

void main()
{
    vec3 vertex = meshOrigin + meshTurn * (meshScale * corner);
    uv = cornerUv;
    place = vertex;
    local = grainOffset + meshScale * corner;
    normal = meshTurn * cornerNormal;
    color = cornerColor;
    gl_Position = toClip * vec4(vertex, 1.0);
}
