// The scene's forces (src/scene/force.h) as accelerations in m/s^2. `x` is relative to the force's position, which the
// caller subtracted from the molecule's anchor exactly. Nothing is singular: what a float leaves of a distance next to 0
// gives no direction and counts as 0.
// Read as C++ through GLM by the tests.

// Returns a pull towards the point by strength / d^2 (m^3/s^2), at most `most`; away from it where the strength is negative.
vec3 inverseSquarePull(vec3 x, float strength, float radius, float most)
{
    float squared = dot(x, x);
    float near = max(squared, 1e-30f);
    float pull = clamp(strength / near, -most, most);
    return x * (squared > radius * radius ? 0.0f : -pull / sqrt(near));
}

// Returns a pull towards the point by `strength` (m/s^2) at any distance within the radius.
vec3 constantPull(vec3 x, float strength, float radius)
{
    float squared = dot(x, x);
    return x * (squared > radius * radius ? 0.0f : -strength / sqrt(max(squared, 1e-30f)));
}

// Returns a pull towards the line, `pull`, and around it, `turn` (m/s^2 at the core's edge): both grow with the distance d as
// d / core within the core, and fall as core / d beyond.
vec3 vortexLinePull(vec3 x, vec3 axis, float pull, float turn, float core, float radius)
{
    vec3 r = x - axis * dot(x, axis);
    float squared = dot(r, r);
    float share = squared > core * core ? core / squared : 1.0f / core;
    return (cross(axis, r) * turn - r * pull) * (squared > radius * radius ? 0.0f : share);
}

// Returns the factor on a velocity, exact over a time t with growth = exp(rate t). What is below the limit grows up to it; what is
// above stays as it is; a growth below 1 damps at any speed.
float thrustFactor(vec3 velocity, float growth, float limit)
{
    float speed = sqrt(dot(velocity, velocity));
    float most = speed < limit ? limit / max(speed, 1e-30f) : 1.0f;
    return growth > 1.0f ? min(growth, most) : growth;
}
