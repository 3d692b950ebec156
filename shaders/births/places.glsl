uniform int laneCount;   // of the sums, WORDS words each
uniform int placeCount;

// Returns the bits of word w that stand for a place.
uint validBits(int w)
{
    int left = placeCount - w * 32;
    return left >= 32 ? 0xffffffffu : left <= 0 ? 0u : (1u << uint(left)) - 1u;
}
