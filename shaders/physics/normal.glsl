// Vertex normals: the sum of the area vectors of the triangles around a vertex (Decker, section 3.5).
// Read as C++ through GLM by the tests.

// Area vector of the triangle whose other corners, anticlockwise, lie at b and c relative to the vertex.
vec3 areaVector(vec3 b, vec3 c)
{
    return cross(b, c);
}

// Unit normal of a sum of area vectors; up where the sum vanishes.
vec3 unitNormal(vec3 sum)
{
    float squared = dot(sum, sum);
    return squared > 1e-30f ? sum / sqrt(squared) : vec3(0.0f, 1.0f, 0.0f);
}
