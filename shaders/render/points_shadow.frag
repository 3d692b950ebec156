// Depth of sprites as the sun sees them, which are round.

void main()
{
    vec2 point = gl_PointCoord * 2.0 - 1.0;
    if (dot(point, point) > 1.0) discard;
}
