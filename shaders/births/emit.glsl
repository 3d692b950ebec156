// The initial place and velocity of what an emitter emits. Everything random depends on the newborn's seed.
// Distributions: src/scene/emitter.h.
#include "physics/random.glsl"
#include "physics/rotation.glsl"

// Counters of a newborn's hashes, beyond those of the frames (fused/step.glsl).
const uint bornPlace = 0xe0000000u;      // and the two after it
const uint bornDirection = 0xe0000003u;  // and the next
const uint bornSpeed = 0xe0000005u;
const uint bornLife = 0xe0000006u;
const uint bornTurn = 0xe0000007u;  // and the two after it
const uint bornScale = 0xe000000au;
const uint bornSpin = 0xe000000bu;  // and the two after it
const uint bornPhase = 0xe000000eu;
const uint bornTime = 0xe000000fu;
const uint bornOutward = 0xe0000010u;  // and the next

float drawn(uint seed, uint counter)
{
    return uniformFrom(hashSeed(seed, counter));
}

// Returns a direction uniform on the unit sphere: height and longitude are independent (Archimedes).
vec3 anyDirection(float u, float v)
{
    float z = 1.0 - 2.0 * u;
    float r = sqrt(max(1.0 - z * z, 0.0));
    float angle = 6.2831853 * v;
    return vec3(r * cos(angle), r * sin(angle), z);
}

// Sets two unit vectors that make a right-handed frame with the unit vector n [Duff 2017].
void frameOf(vec3 n, out vec3 a, out vec3 b)
{
    float s = n.z < 0.0 ? -1.0 : 1.0;
    float p = -1.0 / (s + n.z);
    float q = n.x * n.y * p;
    a = vec3(1.0 + s * n.x * n.x * p, s * q, -s * n.x);
    b = vec3(q, s + n.y * n.y * p, -n.y);
}

// Returns a direction uniform in solid angle within a cone about the axis; cap = 1 - cos(half the opening).
vec3 coneDirection(vec3 axis, float cap, float u, float v)
{
    float below = u * cap;  // 1 - cos, which keeps narrow cones exact
    float r = sqrt(max(below * (2.0 - below), 0.0));
    float angle = 6.2831853 * v;
    vec3 a, b;
    frameOf(axis, a, b);
    return axis * (1.0 - below) + (a * cos(angle) + b * sin(angle)) * r;
}

// These return the distance from the middle of a place uniform in a disc, or in a ball, whose inner part, `hollow` of the
// radius, is empty.
float discRadius(float radius, float hollow, float u)
{
    return radius * sqrt(mix(hollow * hollow, 1.0, u));
}

float ballRadius(float radius, float hollow, float u)
{
    return radius * pow(mix(hollow * hollow * hollow, 1.0, u), 1.0 / 3.0);
}
