// The tree's level 0 (births/tree.glsl): words of bits for 32 places each, of those that are asked for. With compute shaders
// the step has noted what died. In fragments the two sides of the state tell.
#include "state/lanes.glsl"
#pragma reads free
#pragma updates died
#pragma writes sums

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
