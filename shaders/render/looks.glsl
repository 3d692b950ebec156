// The looks of a molecule: its colour by its seed or by a quantity, and how far it has grown. Pure functions; read as
// C++ through GLM by the export and the tests.

#include "physics/random.glsl"

const int mostColors = 8;  // of a scale; src/scene/color_scale.h

// Linear RGB between two colours, most near the first, a few well on their way to the second, and by up to `variation`
// darker or brighter: no channel comes above 1, as a surface sends back no more light than it gets.
vec3 colorOfSeed(uint seed, vec3 first, vec3 second, float variation)
{
    float between = uniformFrom(hashSeed(seed, 0xc0101u));
    vec3 color = mix(first, second, between * between * (1.5f - 0.5f * between));
    float brightness = 1.0f + variation * (2.0f * uniformFrom(hashSeed(seed, 0xc0102u)) - 1.0f);
    float brightest = max(color.x, max(color.y, color.z));
    return color * min(brightness, 1.0f / max(brightest, 1e-6f));
}

// The colour at a quantity: `last`: number of the last colour; `span`: x the quantity of the first, y 1 / (last - first).
vec3 colorOfQuantity(float quantity, vec4 colors[mostColors], int last, vec2 span)
{
    float place = clamp((quantity - span.x) * span.y, 0.0f, 1.0f) * float(last);
    int below = min(int(place), last - 1);
    return mix(vec3(colors[below]), vec3(colors[below + 1]), place - float(below));
}

// The share of its size that a molecule has at an age. `life`: x age, y length of life, s; `growTimes`: s, above 0, after
// birth and before the end.
float grownShare(vec2 life, vec2 growTimes)
{
    return clamp(life.x / growTimes.x, 0.0f, 1.0f) * clamp((life.y - life.x) / growTimes.y, 0.0f, 1.0f);
}
