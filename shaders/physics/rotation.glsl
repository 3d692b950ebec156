// Rotations by unit quaternions: xyz the axis times the sine of half the angle, w its cosine.
// Read as C++ through GLM by the tests.

// These return v rotated by q, and by the inverse of q.
vec3 turned(vec4 q, vec3 v)
{
    vec3 across = cross(vec3(q.x, q.y, q.z), v) * 2.0f;
    return v + across * q.w + cross(vec3(q.x, q.y, q.z), across);
}

vec3 turnedBack(vec4 q, vec3 v)
{
    return turned(vec4(-q.x, -q.y, -q.z, q.w), v);
}

// Returns a uniformly distributed rotation from three numbers uniform in [0, 1) [Shoemake 1992].
vec4 anyRotation(float u, float v, float w)
{
    float angleA = 6.2831853f * v;
    float angleB = 6.2831853f * w;
    float a = sqrt(1.0f - u);
    float b = sqrt(u);
    return vec4(a * sin(angleA), a * cos(angleA), b * sin(angleB), b * cos(angleB));
}
