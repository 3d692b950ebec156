// normals: each vertex sums the area vectors of its triangles (Decker, section 3.5).
// For directional drag the shape is taken where advect will need it: after leapfrog's first half drift.
#include "state/textures.glsl"

uniform float aheadTime;  // s: h/2 before leapfrog's advect, else 0

layout(location = 0) out vec4 normal;

vec3 surfacePlace(int vertex)
{
    ivec2 texel = stateTexel(vertex, ownAddress().y);
    vec3 x = texelFetch(positions, texel, 0).xyz;
#ifdef DIRECTIONAL_DRAG
    if (aheadTime > 0.0) x += kickedVelocity(texel, aheadTime) * aheadTime;
#endif
    return x;
}

#include "step/gather_normal.glsl"

void main()
{
    ivec2 own = ownAddress();
    normal = isPadding(own.y) ? vec4(0.0) : vec4(gatheredNormal(own.x), 0.0);
}
