// Molecules without triangles: every vertex a round sprite. Variant: DEPTH_ONLY.

#include "lib/molecule.glsl"
#include "render/instance_color.glsl"

uniform mat4 toClip;
uniform float pointSize;      // m, diameter
uniform float pixelsPerMeter; // at a distance of one metre, or everywhere in the shadow map

#ifndef DEPTH_ONLY
out vec3 middle;
flat out vec3 color;
#endif

void main()
{
    vec3 at = vertexPlace(gl_InstanceID, gl_VertexID);
    gl_Position = toClip * vec4(at, 1.0);
    gl_PointSize = max(pointSize * pixelsPerMeter / gl_Position.w, 1.0);
#ifndef DEPTH_ONLY
    middle = at;
    color = instanceColor(moleculeSeed(gl_InstanceID));
#endif
}
