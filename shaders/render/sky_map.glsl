// The upper hemisphere on a square: a stereographic picture from below, the horizon on the circle within.

vec2 onSkyMap(vec3 direction)
{
    return 0.5 + 0.5 * direction.xz / (1.0 + direction.y);
}

vec3 fromSkyMap(vec2 uv)
{
    vec2 p = uv * 2.0 - 1.0;
    float r2 = dot(p, p);
    return vec3(2.0 * p.x, 1.0 - r2, 2.0 * p.y) / (1.0 + r2);
}
