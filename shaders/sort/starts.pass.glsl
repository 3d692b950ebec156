// Writes for each key, of `numbers`, the first slot whose key is not below it.
#include "state/lanes.glsl"
#include "sort/pairs.glsl"
#pragma reads sorted
#pragma writes starts

uniform int count;  // of slots

void main()
{
    putStarts(ownLane(), uint(placeOfKey(sorted, uint(ownLane()), count)));
}
