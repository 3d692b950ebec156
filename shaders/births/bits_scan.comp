// One workgroup: the sums before each lane's words, and what follows from their total: how many died (DEATHS), or how
// many of the births that are asked for find a place.
#include "births/control.glsl"
#include "births/places.glsl"

layout(local_size_x = LANES) in;

#include "sort/group_scan.glsl"

layout(std430) buffer Counts { uvec2 counts[]; };
layout(std430) buffer Control { uint control[]; };

uniform int controlBase;
#ifndef DEATHS
uniform int scheduled;      // births that the CPU knows of
uniform int allocates;      // 0: only counts
uniform int deathRunCount;
uniform ivec4 deathRuns[mostDeathRuns];  // x control of the group that dies, y births for each
#include "births/reach.glsl"
#endif

shared uint tops[LANES];

#ifndef DEATHS
void count(int which, uint more)
{
    control[controlBase + which] = counted(control[controlBase + which], more);
}
#endif

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int chunk = (laneCount + LANES - 1) / LANES;
    int first = lane * chunk;
    int last = min(first + chunk, laneCount);
    uint sum = 0u;
    uint top = 0u;
    for (int i = first; i < last; ++i) {
        sum += counts[i].x;
        top = max(top, counts[i].y);
    }
    tops[lane] = top;
    uint total;
    uint before = sumBefore(sum, total);
    for (int i = first; i < last; ++i) {
        uint own = counts[i].x;
        counts[i].x = before;
        before += own;
    }
    if (lane != 0) return;
#ifdef DEATHS
    control[controlBase + controlDeaths] = total;
#else
    uint mark = 0u;
    for (int i = 0; i < LANES; ++i) mark = max(mark, tops[i]);
    uint requested = uint(scheduled);
    for (int d = 0; d < deathRunCount; ++d) {
        control[controlBase + controlFirsts + d] = requested;
        requested += control[deathRuns[d].x + controlDeaths] * uint(deathRuns[d].y);
    }
    uint born = allocates != 0 ? min(requested, total) : 0u;
    control[controlBase + controlLive] = uint(placeCount) - total + born;
    control[controlBase + controlMarkBefore] = control[controlBase + controlMark];
    reachTo(mark);
    if (allocates != 0) {
        control[controlBase + controlRequested] = requested;
        control[controlBase + controlBorn] = born;
        count(controlLost, requested - born);
        count(controlBornEver, born);
        uint groups = (born + 63u) / 64u;
        uint rows = (groups + mostGroups - 1u) / mostGroups;
        control[controlBase + controlBirthGroups] = rows > 1u ? (groups + rows - 1u) / rows : groups;
        control[controlBase + controlBirthGroups + 1] = max(rows, 1u);
    }
#endif
}
