// The surface around a vertex from the topology table, where it is not compiled in. Needs a vertex's surfacePlace (m).
#include "physics/normal.glsl"
#include "state/topology.glsl"

// Returns the unit normal of the triangles around a vertex; 0 if there are none. Each is taken from its first corner, so
// that it is the same to the bit around all three.
vec3 gatheredNormal(int vertex)
{
    vec4 spans = table(topologyBase + vertex);
    int first = int(spans.z);
    int count = int(spans.w);
    vec3 place = surfacePlace(vertex);
    vec3 sum = vec3(0.0);
    vec3 area = vec3(0.0);  // added a turn later: Mesa would add both products of a cross product one after the other
    for (int t = 0; t < count; ++t) {
        vec4 corners = table(first + t);
        vec3 next = surfacePlace(int(corners.x));
        vec3 last = surfacePlace(int(corners.y));
        vec3 from = corners.z == 0.0 ? place : corners.z == 1.0 ? last : next;
        vec3 to = corners.z == 0.0 ? next : corners.z == 1.0 ? place : last;
        vec3 other = corners.z == 0.0 ? last : corners.z == 1.0 ? next : place;
        sum += area;
        area = areaVector(to - from, other - from);
    }
    return count > 0 ? unitNormal(sum + area) : vec3(0.0);
}
