// A level of the tree (births/tree.glsl). Level 0 (BITS) has words of bits for 32 places each, of those that are asked for: with compute shaders
// the step has noted what died, in fragments the two sides of the state tell. Above it a node counts what is set in 32 nodes of the level
// below.
#include "state/lanes.glsl"
#pragma writes sums
#ifdef BITS
#pragma reads free
#pragma updates died

uniform int ofDeaths;    // whether a bit is set for a place in which a molecule died in this step, or for a free one
uniform int placeCount;  // the group's capacity
uniform int firstPlace;  // asked for are `askedFor` places from this one on, around the capacity
uniform int askedFor;

// Returns a word's bits below a place.
uint bitsBelow(int place, int firstOfWord)
{
    int count = clamp(place - firstOfWord, 0, 32);
    return count == 32 ? 0xffffffffu : (1u << uint(count)) - 1u;
}

uint askedIn(int word)
{
    int first = 32 * word;
    int last = firstPlace + askedFor;
    uint straight = bitsBelow(min(last, placeCount), first) & ~bitsBelow(firstPlace, first);
    return straight | bitsBelow(last - placeCount, first);
}

#ifdef TEXTURES
#include "state/packed.glsl"
uniform sampler2DArray states;
uniform sampler2DArray statesBefore;  // the step

bool isTaken(sampler2DArray values, int place)
{
    return packedLife(values, firstElement(place, STATE_ELEMENTS)).y > 0.0;
}

uint bitsOf(int word, uint asked)
{
    uint bits = 0u;
    for (int i = 0; i < 32; ++i) {
        uint bit = 1u << uint(i);
        int place = 32 * word + i;
        if ((asked & bit) == 0u || isTaken(states, place)) continue;
        if (ofDeaths == 0 || isTaken(statesBefore, place)) bits |= bit;
    }
    return bits;
}
#else
uniform int firstWord;  // of the group

uint bitsOf(int word, uint asked)
{
    return asked & (ofDeaths != 0 ? diedAt(firstWord + word) : freeAt(firstWord + word));
}
#endif

void main()
{
    int four = ownLane();
    uvec4 bits = uvec4(0u);
    for (int i = 0; i < 4; ++i) {
        int word = 4 * four + i;
        uint asked = askedIn(word);
        if (asked == 0u) continue;
        bits[i] = bitsOf(word, asked);
        if (ofDeaths != 0) putDied(firstWord + word, 0u);  // fragments lack the array, and nothing of this is left there
    }
    putSums(four, bits);
}
#else
#include "births/bits_in.glsl"
#pragma reads sumsBelow

uniform ivec4 below;  // the level below: x where it begins, y how many fours of nodes there are, z whether they are bits

void main()
{
    int four = ownLane();
    uvec4 sums = uvec4(0u);
    for (int node = 0; node < 4; ++node) {
        int first = 8 * (4 * four + node);
        ivec4 sum = ivec4(0);
        for (int child = first; child < min(first + 8, below.y); ++child) {
            uvec4 values = sumsBelowAt(below.x + child);
            sum += below.z != 0 ? bitsIn(values) : ivec4(values);
        }
        sums[node] = uint(sum.x + sum.y + sum.z + sum.w);
    }
    putSums(firstNumber + four, sums);
}
#endif
