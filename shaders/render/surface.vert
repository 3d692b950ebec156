// A triangle mesh of the scene: host models, terrain, colliders. Variants: DEPTH_ONLY; IMAGES, which lie
// by texture coordinates.

layout(location = 0) in vec3 corner;  // m, relative to the mesh's own origin
layout(location = 1) in vec3 cornerNormal;
layout(location = 2) in vec3 cornerColor;
#ifdef IMAGES
layout(location = 3) in vec2 cornerUv;
out vec2 uv;
#endif

uniform mat4 toClip;
uniform vec3 meshOrigin;  // relative to the origin of drawing, m
uniform float meshScale;
uniform mat3 meshTurn;
#ifndef DEPTH_ONLY
uniform vec3 grainOffset;  // of the mesh in the procedural grain, m
#endif

#ifndef DEPTH_ONLY
out vec3 place;
out vec3 local;
out vec3 normal;
out vec3 color;
#endif

void main()
{
#ifdef IMAGES
    uv = cornerUv;
#endif
    vec3 at = meshOrigin + meshTurn * (meshScale * corner);
#ifndef DEPTH_ONLY
    place = at;
    local = grainOffset + meshScale * corner;
    normal = meshTurn * cornerNormal;
    color = cornerColor;
#endif
    gl_Position = toClip * vec4(at, 1.0);
}
