// bits: a texel a word of 32 places, in rows of 32 words: x the free ones and, with DEATHS, y those in which one died in
// this step. The first place of them is `firstPlace`, and they go on around the capacity.
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
