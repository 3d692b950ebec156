// Adds to each vertex of one group what its sphere has gained by contacts (contact/response/gains.pass.glsl).
#include "state/textures.glsl"
#include "state/numbered.glsl"

uniform sampler2DArray gains;
uniform int firstSphere;  // of the group

layout(location = 0) out vec4 newPosition;
layout(location = 1) out vec4 newVelocity;

void main()
{
    ivec2 own = ownAddress();
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 x = texelFetch(positions, texel, 0).xyz;
    vec3 v = texelFetch(velocities, texel, 0).xyz;
    if (!isPadding(own.y)) {
        ivec2 sphere = texelOf(firstSphere + own.y * vertexCount + own.x);
        v += texelFetch(gains, ivec3(sphere, 0), 0).xyz;
        x += texelFetch(gains, ivec3(sphere, 1), 0).xyz;
    }
    newPosition = vec4(x, 0.0);
    newVelocity = vec4(v, 0.0);
}
