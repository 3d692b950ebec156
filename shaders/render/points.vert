// Molecules without triangles: every vertex a round sprite. Variants are those of render/drawn.glsl.

#include "state/molecule.glsl"
#include "render/drawn.glsl"
#include "render/instance_color.glsl"

uniform mat4 toClip;
uniform float pointSize;      // m, diameter
uniform float pixelsPerMeter; // at a distance of one metre, or everywhere in the shadow map

out vec3 middle;
flat out vec3 color;

void main()
{
    int molecule;
    bool drawn = findDrawn(gl_InstanceID, gl_InstanceID + 1, molecule);
    vec3 vertex = vertexPlace(molecule, gl_VertexID);
    gl_Position = toClip * vec4(vertex, 1.0);
    if (!drawn) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
    gl_PointSize = max(pointSize * pixelsPerMeter / gl_Position.w, 1.0);
    middle = vertex;
    color = instanceColor(molecule);
}
