// Depth of sprites as the sun sees them: round.

void main()
{
    vec2 at = gl_PointCoord * 2.0 - 1.0;
    if (dot(at, at) > 1.0) discard;
}
