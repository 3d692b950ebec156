// The looks of a particle at an age, from its type and its seed: nothing of it is stored [Latta 2004, section
// 3.3]. Pure functions; read as C++ through GLM by the tests.

#include "physics/random.glsl"
#include "physics/rotation.glsl"

// Counters of the random numbers, one for each attribute.
const uint sizeCounter = 0xa71c01u;
const uint turnCounter = 0xa71c02u;
const uint spinCounter = 0xa71c03u;
const uint tileCounter = 0xa71c04u;
const uint axisCounter = 0xa71c05u;      // and the next one
const uint rotationCounter = 0xa71c07u;  // and the next two

const float fullTurn = 6.2831853f;

float randomBetween(vec2 span, uint seed, uint counter)
{
    return mix(span.x, span.y, uniformFrom(hashSeed(seed, counter)));
}

// Share of its life, in [0, 1], from x age and y length of life.
float ageShare(vec2 life)
{
    return clamp(life.x / max(life.y, 1e-9f), 0.0f, 1.0f);
}

// Colour and opacity along up to three straight pieces, without a branch: each adds the part of its change that is
// behind. `begin`: the ages at which the pieces begin; `perAge`: 1 / their lengths, 0 for a piece that is not there.
vec4 colorAt(float age, vec4 first, vec4 change0, vec4 change1, vec4 change2, vec3 begin, vec3 perAge)
{
    vec3 done = clamp((age - begin) * perAge, vec3(0.0f), vec3(1.0f));
    return max(first + change0 * done.x + change1 * done.y + change2 * done.z, vec4(0.0f));
}

// Tiles of a flip-book that shows: x one, y the next one, z the share of the next one. `count`: of tiles, at least 2.
// Once: from the first tile at age 0 to the last at age 1.
vec3 framesOnce(float age, float count, bool blend)
{
    float position = blend ? age * (count - 1.0f) : min(age * count, count - 1.0f);
    float frame = min(floor(position), count - 2.0f);
    return blend ? vec3(frame, frame + 1.0f, position - frame) : vec3(floor(position), floor(position), 0.0f);
}

// The same for a flip-book that repeats. `start`: the share of all tiles at 0 seconds.
vec3 framesAgain(float seconds, float rate, float start, float count, bool blend)
{
    float position = fract(seconds * rate / count + start) * count;
    float frame = min(floor(position), count - 1.0f);  // rounding may reach count
    float next = frame + 1.0f < count ? frame + 1.0f : 0.0f;
    return vec3(frame, next, blend ? clamp(position - frame, 0.0f, 1.0f) : 0.0f);
}

// rad, of what turns by `rate` rad/s, after `blocks` times 64 s and `rest` s: less the whole turns of the blocks, whose
// shares of a turn are counted in 2^-32.
float turnedBy(float rate, uint blocks, float rest)
{
    uint share = uint(min(fract(rate * (64.0f / fullTurn)) * 4294967296.0f, 4294967040.0f));
    return rate * rest + float(share * blocks) * (fullTurn / 4294967296.0f);
}

// Returns one of `count` tiles, each as likely.
float randomTile(uint seed, float count)
{
    return min(floor(uniformFrom(hashSeed(seed, tileCounter)) * count), count - 1.0f);
}

vec4 aboutAxis(vec3 axis, float angle)
{
    return vec4(axis * sin(0.5f * angle), cos(0.5f * angle));
}

// Returns the rotation b followed by a.
vec4 composed(vec4 a, vec4 b)
{
    vec3 av = vec3(a), bv = vec3(b);
    return vec4(a.w * bv + b.w * av + cross(av, bv), a.w * b.w - dot(av, bv));
}

// Returns a uniformly distributed direction.
vec3 randomAxis(uint seed)
{
    float z = 2.0f * uniformFrom(hashSeed(seed, axisCounter)) - 1.0f;
    float angle = fullTurn * uniformFrom(hashSeed(seed, axisCounter + 1u));
    float across = sqrt(max(1.0f - z * z, 0.0f));
    return vec3(across * cos(angle), across * sin(angle), z);
}

vec4 randomRotation(uint seed)
{
    return anyRotation(uniformFrom(hashSeed(seed, rotationCounter)), uniformFrom(hashSeed(seed, rotationCounter + 1u)),
                       uniformFrom(hashSeed(seed, rotationCounter + 2u)));
}
