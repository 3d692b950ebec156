// The places in which a molecule of a group died in this step, as a list in ascending order.
#include "births/control.glsl"
#include "births/tree.glsl"
#include "state/lanes.glsl"
#pragma reads control
#pragma writes deaths

uniform int group;
uniform int firstRank;  // of this pass

void main()
{
    int lane = ownLane();
    int rank = firstRank + lane;
    uint count = controlAt(group, controlDeaths / 4)[controlDeaths % 4];
    putDeaths(firstNumber + lane, uint(rank) < count ? uint(placeOfRank(rank)) : 0u);
}
