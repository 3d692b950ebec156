// bits: each texel is a word of 32 places, in rows of 32 words: x has the bits of the free places and, with DEATHS, y
// those of the places in which a molecule died in this step. The places begin with `firstPlace` and wrap around at the
// capacity.
#include "state/packed.glsl"

uniform sampler2DArray states;
uniform sampler2DArray statesBefore;  // the step
uniform int firstPlace;
uniform int items;       // places
uniform int placeCount;  // the capacity

layout(location = 0) out uvec4 bits;

bool isTaken(sampler2DArray values, int place)
{
    return packedLife(values, firstElement(place, STATE_ELEMENTS)).y > 0.0;
}

void main()
{
    int first = (int(gl_FragCoord.y) * 32 + int(gl_FragCoord.x)) * 32;
    bits = uvec4(0u);
    for (int i = 0; i < 32; ++i) {
        if (first + i >= items) break;
        int place = (firstPlace + first + i) % placeCount;
        if (!isTaken(states, place)) {
            bits.x |= 1u << uint(i);
#ifdef DEATHS
            if (isTaken(statesBefore, place)) bits.y |= 1u << uint(i);
#endif
        }
    }
}
