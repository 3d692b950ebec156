// Random numbers that depend on a molecule's seed and a counter, never on its index.
// PCG with output permutation RXS-M-XS [O'Neill 2014]. Read as C++ through GLM by the tests.

uint hashSeed(uint seed, uint counter)
{
    uint state = (seed ^ (counter * 2654435769u)) * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Uniform in [0, 1).
float uniformFrom(uint hash)
{
    return float(hash >> 8u) / 16777216.0f;
}

// Whether a molecule's pins are released in a frame: by a pull (N) above a limit, or by chance.
bool isReleased(float pull, float limit, uint seed, int frame, float chance)
{
    return pull > limit || uniformFrom(hashSeed(seed, uint(frame))) < chance;
}
