// normals: each vertex sums the area vectors of its triangles (Decker, section 3.5).
// For directional drag the shape is taken where advect will need it: after leapfrog's first half drift.
#include "state/textures.glsl"
#include "physics/normal.glsl"

uniform float aheadTime;  // s: h/2 before leapfrog's advect, else 0

layout(location = 0) out vec4 normal;

vec3 positionAhead(int vertex, int molecule)
{
    ivec2 texel = stateTexel(vertex, molecule);
    vec3 x = texelFetch(positions, texel, 0).xyz;
#if defined(LEAPFROG) && defined(DIRECTIONAL_DRAG)
    if (aheadTime > 0.0) {
        vec3 v = texelFetch(velocities, texel, 0).xyz;
#ifdef SPRINGS
        v += texelFetch(accelerations, texel, 0).xyz * aheadTime;
#endif
        x += v * aheadTime;
    }
#endif
    return x;
}

void main()
{
    ivec2 own = ownAddress();
    if (isPadding(own.y)) {
        normal = vec4(0.0);
        return;
    }
    vec4 spans = table(topologyBase + own.x);
    vec3 x = positionAhead(own.x, own.y);
    vec3 sum = vec3(0.0);
    int first = int(spans.z);
    int count = int(spans.w);
    for (int i = 0; i < count; ++i) {
        vec4 corners = table(first + i);
        sum += areaVector(positionAhead(int(corners.x), own.y) - x, positionAhead(int(corners.y), own.y) - x);
    }
    normal = vec4(unitNormal(sum, count > 0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0)), 0.0);
}
