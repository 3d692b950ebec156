// Sums of set bits, and one past the last clear one that stands for a place; a lane each WORDS words.
#include "births/control.glsl"
#include "births/places.glsl"

layout(local_size_x = LANES) in;

layout(std430) readonly buffer Bits { uint bits[]; };
layout(std430) writeonly buffer Counts { uvec2 counts[]; };  // x set bits, y one past the last clear one

void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    if (lane >= laneCount) return;
    uint sum = 0u;
    uint top = 0u;
    for (int i = 0; i < WORDS; ++i) {
        int w = lane * WORDS + i;
        uint word = bits[w];
        sum += uint(bitCount(word));
        uint takenBits = ~word & validBits(w);
        if (takenBits != 0u) top = uint(w * 32 + findMSB(takenBits) + 1);
    }
    counts[lane] = uvec2(sum, top);
}
