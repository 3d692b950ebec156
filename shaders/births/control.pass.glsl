// Renews the words of control of one group from the sums over its places: how many molecules died there, how many newborns
// took a place that was not free, or how many of the births that are asked for find a place.
#include "births/control.glsl"
#include "births/tree.glsl"
#include "state/lanes.glsl"
#pragma reads control
#pragma writes nextControl reaches

uniform int group;
uniform int renewal;        // what is renewed (BirthPasses::Renewal)
uniform int summedPlaces;   // over which the sums go
uniform int scheduled;      // births that the CPU knows of
uniform int deathRunCount;
uniform ivec4 deathRuns[MOST_DEATH_RUNS];  // x the group that dies, y births for each
uniform ivec4 parts;        // of the group's state: x the first, y how many, z places of each, w molecules of a workgroup

const int ofDeaths = 0;
const int ofCuts = 1;  // lives that a birth cut short
const int ofCounts = 3;  // births are counted, and none finds a place

const uint mostRequested = 0x40000000u;  // none beyond finds a place

uvec4 words[8];

uint wordOf(int which)
{
    return words[which / 4][which % 4];
}

void put(int which, uint value)
{
    words[which / 4][which % 4] = value;
}

// A counter stays at the largest number.
void count(int which, uint more)
{
    put(which, wordOf(which) + min(more, 0xffffffffu - wordOf(which)));
}

// Returns one past the last place that is taken.
int findMark()
{
    int node = 0;
    for (int level = levels; level >= 0; --level) {
        int places = 32 << (5 * level);  // of a node
        int last = 32 * node + 31;
        for (; last >= 32 * node; --last) {
            int here = clamp(summedPlaces - last * places, 0, places);
            if (here > 0 && countsIn(level, last / 4)[last % 4] < here) break;
        }
        if (last < 32 * node) return 0;
        node = last;
    }
    int mark = min(summedPlaces - 32 * node, 32);
    uint word = fourAt(0, node / 4)[node % 4];
    while (((word >> uint(mark - 1)) & 1u) == 1u) --mark;
    return 32 * node + mark;
}

void putBirths(bool allocates)
{
    uint requested = uint(scheduled);
    for (int d = 0; d < deathRunCount; ++d) {
        put(controlFirsts + d, requested);
        uint deaths = controlAt(deathRuns[d].x, controlDeaths / 4)[controlDeaths % 4];
        uint each = uint(deathRuns[d].y);
        requested += min(deaths, (mostRequested - min(requested, mostRequested)) / each) * each;
    }
    uint free = uint(countInAll());
    uint born = allocates ? min(requested, free) : 0u;
    int mark = findMark();
    if (born > 0u) mark = max(mark, placeOfRank(int(born) - 1) + 1);
    put(controlLive, uint(summedPlaces) - free + born);
    put(controlMarkBefore, wordOf(controlMark));
    put(controlMark, uint(mark));
    if (!allocates) return;
    put(controlRequested, requested);
    put(controlBorn, born);
    count(controlLost, requested - born);
    count(controlBornEver, born);
    uint groups = (born + uint(BIRTH_LANES) - 1u) / uint(BIRTH_LANES);
    uint rows = max((groups + uint(MOST_GROUPS) - 1u) / uint(MOST_GROUPS), 1u);
    put(controlBirthGroups, (groups + rows - 1u) / rows);
    put(controlBirthGroups + 1, rows);
    put(controlBirthGroups + 2, 1u);
}

// The next step goes one past the last place that is taken, or was one step before, on the other side of the state.
void putReach()
{
    int reach = int(max(wordOf(controlMark), wordOf(controlMarkBefore)));
    for (int p = 0; p < parts.y; ++p) {
        int here = clamp(reach - p * parts.z, 0, parts.z);
        putReaches(parts.x + p, uvec4(uint((here + parts.w - 1) / parts.w), 1u, 1u, 0u));
    }
}

void main()
{
    int own = ownLane();
    for (int k = 0; k < 8; ++k) words[k] = controlAt(own, k);
    if (own == group) {
        if (renewal == ofDeaths) {
            put(controlDeaths, uint(countInAll()));
        } else if (renewal == ofCuts) {
            count(controlLost, uint(summedPlaces - countInAll()));
        } else {
            putBirths(renewal != ofCounts);
            putReach();
        }
    }
    putAllNextControl(own, words);
}
