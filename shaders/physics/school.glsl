// How the members of a school steer [Reynolds 1987], as accelerations in m/s^2. None is singular: separation does not
// part two members in the same place. Read as C++ through GLM by the tests.

// Returns a push away from a member at -d (m): of size 1 at the distance 0, falling to 0 at the radius.
vec3 awayFrom(vec3 d, float radius)
{
    float squared = dot(d, d);
    float inverse = 1.0f / sqrt(max(squared, 1e-20f));
    return d * max(inverse - 1.0f / radius, 0.0f);
}

// Whether what is at d is outside the blind cone behind. forward: unit.
bool isSeen(vec3 d, vec3 forward, float blindCosine)
{
    float along = dot(d, forward);
    return along >= 0.0f || along * along <= blindCosine * blindCosine * dot(d, d);
}

// Returns v, cut to the length `most`.
vec3 atMost(vec3 v, float most)
{
    float squared = dot(v, v);
    return v * min(1.0f, most / sqrt(max(squared, 1e-20f)));
}

// Returns `first`, cut to the length `most`, plus as much of `then` as that leaves room for.
vec3 inTurn(vec3 first, vec3 then, float most)
{
    vec3 a = atMost(first, most);
    return a + atMost(then, max(most - sqrt(dot(a, a)), 0.0f));
}

// Returns the way back between two bounds, m.
vec3 backInto(vec3 p, vec3 low, vec3 high)
{
    return clamp(p, low, high) - p;
}

// Returns the way back into a ball, m.
vec3 backIntoBall(vec3 p, vec3 center, float radius)
{
    vec3 d = center - p;
    float r = sqrt(dot(d, d));
    return d * (max(r - radius, 0.0f) / max(r, 1e-20f));
}

// Returns the unit direction of the wanted velocity, or `forward` where that is zero or upright, made no steeper than the tangent
// `steepest` allows.
vec3 courseOf(vec3 wanted, vec3 forward, float steepest)
{
    float level = sqrt(wanted.x * wanted.x + wanted.z * wanted.z);
    vec3 d = level > 1e-6f ? wanted / level : forward;
    float most = steepest * sqrt(d.x * d.x + d.z * d.z);
    d.y = clamp(d.y, -most, most);
    return d / sqrt(max(dot(d, d), 1e-20f));
}

// Returns the turn from one unit vector to another, its axis times its angle in rad: about the vertical and in steepness at once, so that
// it is on its way no steeper than the steeper of the two. The shortest turn to a course behind would lead over the top.
vec3 turnBetween(vec3 from, vec3 to)
{
    float fromLevel = sqrt(from.x * from.x + from.z * from.z);
    float toLevel = sqrt(to.x * to.x + to.z * to.z);
    float yaw = atan(from.z * to.x - from.x * to.z, from.x * to.x + from.z * to.z + 1e-20f);
    float pitch = atan(to.y, toLevel + 1e-20f) - atan(from.y, fromLevel + 1e-20f);
    return vec3(0.0f, yaw, 0.0f) + vec3(-from.z, 0.0f, from.x) * (pitch / max(fromLevel, 1e-6f));
}

// A sine whose frequency is a multiple of 1/256 rad/s, so that all such sines repeat after 512 pi s (wanderPeriod of
// src/simulate/school_passes.cpp). random in [0, 1).
float wanderSine(float time, float least, float random, float phase)
{
    return sin(time * ((least + floor(256.0f * random)) / 256.0f) + 40.0f * phase);
}

// Returns a number that wanders in [-1, 1]: the mean of three sines whose periods, 2 to 7 s, and phases depend on the seed.
float wanderOf(float time, float a, float b, float c)
{
    return (wanderSine(time, 230.0f, a, b) + wanderSine(time, 435.0f, b, c) + wanderSine(time, 666.0f, c, a)) / 3.0f;
}
