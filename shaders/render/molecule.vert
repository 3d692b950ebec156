// A molecule's corner, straight from the state: gl_InstanceID is the molecule, gl_VertexID its vertex. Variants are those of
// render/drawn.glsl.

#include "state/molecule.glsl"
#include "render/drawn.glsl"
#include "render/grown.glsl"
#include "render/instance_color.glsl"

layout(location = 0) in vec2 cornerUv;

uniform mat4 toClip;

out vec2 uv;
out vec3 place;
out vec3 normal;
flat out vec3 color;

void main()
{
    int molecule;
    bool drawn = findDrawn(gl_InstanceID, gl_InstanceID + 1, molecule);
    vec3 vertex = drawnPlace(molecule, gl_VertexID);
    uv = cornerUv;
    place = vertex;
    normal = vertexNormal(molecule, gl_VertexID);
    color = instanceColor(molecule);
    gl_Position = toClip * vec4(vertex, 1.0);
    if (!drawn) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
}
