// A sphere of contact on a triangle: a point that moves as the weighted mean of its corners, and passes an impulse on to them by the same weights.
// Its texel of `shapes`: xyz the corners, w their parts, i + 256 j + 65536 (i + j + k), of which a corner's weight is i / (i + j + k).

struct TrianglePoint {
    ivec3 corners;
    vec3 parts;
    float all;
};

TrianglePoint trianglePoint(vec4 shape)
{
    uint texel = uint(shape.w);
    vec2 first = vec2(texel & 255u, texel >> 8u & 255u);
    float all = float(texel >> 16u);
    return TrianglePoint(ivec3(shape.xyz), vec3(first, all - first.x - first.y), all);
}

TrianglePoint vertexPoint(int vertex)
{
    return TrianglePoint(ivec3(vertex), vec3(1.0, 0.0, 0.0), 1.0);
}
