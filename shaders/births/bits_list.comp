// The first set bits as a list of their places, in ascending order. With DEATHS all of them, and the bits are cleared;
// else as many as are born, whose bits are cleared.
#include "births/control.glsl"
#include "births/places.glsl"

layout(local_size_x = LANES) in;

layout(std430) buffer Bits { uint bits[]; };
layout(std430) readonly buffer Counts { uvec2 counts[]; };
layout(std430) buffer Control { uint control[]; };
layout(std430) writeonly buffer List { uint list[]; };

uniform int controlBase;
uniform int listFirst;  // rank of the first entry of List,
uniform int listCount;  // and how many there are
uniform int clears;     // 0: another dispatch over the same bits follows, for the rest of the list
#ifndef DEATHS
#include "births/reach.glsl"
#endif

void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    if (lane >= laneCount) return;
#ifdef DEATHS
    uint limit = control[controlBase + controlDeaths];
#else
    uint limit = control[controlBase + controlBorn];
#endif
    uint rank = counts[lane].x;
    for (int w = lane * WORDS; w < (lane + 1) * WORDS && rank < limit; ++w) {
        uint word = bits[w];
        uint before = word;
        while (word != 0u && rank < limit) {
            uint place = uint(w * 32 + findLSB(word));
            word &= word - 1u;
            int at = int(rank) - listFirst;
            if (at >= 0 && at < listCount) list[at] = place;
            ++rank;
#ifndef DEATHS
            if (rank == limit) {  // the last newborn, which only this lane reaches
                reachTo(max(control[controlBase + controlMark], place + 1u));
            }
#endif
        }
        if (clears != 0 && word != before) bits[w] = word;
    }
}
