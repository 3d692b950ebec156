// Signed distance and unit normal of solids: xyz normal towards the free side, w distance in m (negative
// inside), exact on both sides. A normal is a unit vector everywhere: where several are as good (a centre, an
// axis, an edge from inside) one of them. Read as C++ through GLM by the tests.
#include "physics/rotation.glsl"

// Below this length, m, squares are lost to rounding, and a direction with them.
const float noDirection = 1e-15f;

// x: relative to the centre.
vec4 sphereSurface(vec3 x, float radius)
{
    float r = length(x);
    return vec4(r > noDirection ? x / r : vec3(0.0f, 1.0f, 0.0f), r - radius);
}

// x: relative to the centre, along the box's own axes.
vec4 boxSurface(vec3 x, vec3 halfSize)
{
    vec3 q = abs(x) - halfSize;
    vec3 beyond = max(q, vec3(0.0f));
    float outside = length(beyond);
    // inside: the nearest face
    vec3 face = q.x >= q.y && q.x >= q.z ? vec3(1.0f, 0.0f, 0.0f)
                : q.y >= q.z             ? vec3(0.0f, 1.0f, 0.0f)
                                         : vec3(0.0f, 0.0f, 1.0f);
    bool off = outside > noDirection;
    vec3 n = off ? beyond / outside : face;
    vec3 side = vec3(x.x < 0.0f ? -1.0f : 1.0f, x.y < 0.0f ? -1.0f : 1.0f, x.z < 0.0f ? -1.0f : 1.0f);
    return vec4(n * side, off ? outside : max(q.x, max(q.y, q.z)));
}

// x: relative to one end. axis: from there to the other; perLength: 1 / |axis|^2, 0 where the ends coincide.
// aside: a unit vector across the axis.
vec4 capsuleSurface(vec3 x, vec3 axis, float perLength, vec3 aside, float radius)
{
    vec3 off = x - axis * clamp(dot(x, axis) * perLength, 0.0f, 1.0f);
    float r = length(off);
    return vec4(r > noDirection ? off / r : aside, r - radius);
}
