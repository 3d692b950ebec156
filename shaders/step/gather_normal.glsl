// The surface around a vertex from the topology table, where it is not compiled in. Needs a vertex's surfacePlace (m).
#include "physics/normal.glsl"
#include "state/topology.glsl"

// Returns the unit normal of the triangles around a vertex; 0 if there are none.
vec3 gatheredNormal(int vertex)
{
    vec4 spans = table(topologyBase + vertex);
    int first = int(spans.z);
    int count = int(spans.w);
    vec3 place = surfacePlace(vertex);
    vec3 sum = vec3(0.0);
    for (int t = 0; t < count; ++t) {
        vec4 corners = table(first + t);
        sum += areaVector(surfacePlace(int(corners.x)) - place, surfacePlace(int(corners.y)) - place);
    }
    return count > 0 ? unitNormal(sum) : vec3(0.0);
}
