// The remembered impulses of contacts between molecules act on a vertex (contact/response/gains.pass.glsl).
#include "state/textures.glsl"
#ifdef REMEMBERS
#include "state/numbered.glsl"

uniform sampler2D contactLoads;  // m/s^2, by sphere
uniform int firstSphere;         // of the group
#endif

// Returns their acceleration, m/s^2. `own`: x vertex, y molecule.
vec3 loadOn(ivec2 own)
{
#ifdef REMEMBERS
    return fetch(contactLoads, firstSphere + own.y * vertexCount + own.x).xyz;
#else
    return vec3(0.0);
#endif
}
