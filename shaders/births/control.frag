// words: the words of control, four a texel. The words of one group are computed from the sums over its places: with
// DEATHS how many molecules died, with CUTS how many newborns took a place that was not free, else how many of the
// requested births find a place.
#include "births/ranks.glsl"
#include "births/words.glsl"

uniform usampler2D control;  // before
uniform int controlBase;
uniform int items;           // places, over which the sums go
uniform int scheduled;       // births that the CPU knows of
uniform int allocates;       // 0: only counts
uniform int deathRunCount;
uniform ivec4 deathRuns[mostDeathRuns];  // x control of the group that dies, y births for each

layout(location = 0) out uvec4 words;

int first;  // of these words, of the group's
uvec4 now;

void put(int which, uint value)
{
    if (which - first >= 0 && which - first < 4) now[which - first] = value;
}

uint before(int which)
{
    return wordOfControl(control, controlBase + which);
}

#if !defined(DEATHS) && !defined(CUTS)
// The last child that is not all free, where each stands for so many places; -1: there is none.
int takenChildOf(usampler2D sums, int parent, int places)
{
    if (parent < 0) return -1;
    for (int child = parent * 32 + 31; child >= parent * 32; --child) {
        int left = clamp(items - child * places, 0, places);
        if (left > 0 && int(texelFetch(sums, ivec2(child % 32, parent), 0).z) < left) return child;
    }
    return -1;
}

// One past the last place that is taken.
int findMark()
{
    int item = 0;
#if LEVELS > 3
    item = takenChildOf(sums4, item, 1 << 20);
#endif
#if LEVELS > 2
    item = takenChildOf(sums3, item, 1 << 15);
#endif
#if LEVELS > 1
    item = takenChildOf(sums2, item, 1 << 10);
#endif
    item = takenChildOf(sums1, item, 1 << 5);
    if (item < 0) return 0;
    uint word = texelFetch(bits, ivec2(item % 32, item / 32), 0).x;
    int mark = min(items - item * 32, 32);
    while (mark > 0 && ((word >> uint(mark - 1)) & 1u) == 1u) --mark;
    return item * 32 + mark;
}

void putBirths()
{
    uint requested = uint(scheduled);
    for (int d = 0; d < deathRunCount; ++d) {
        put(controlFirsts + d, requested);
        requested += wordOfControl(control, deathRuns[d].x + controlDeaths) * uint(deathRuns[d].y);
    }
    uint free = bitsInAll();
    uint born = allocates != 0 ? min(requested, free) : 0u;
    int mark = findMark();
    if (born > 0u) mark = max(mark, placeOfRank(born - 1u) + 1);
    put(controlLive, uint(items) - free + born);
    put(controlMark, uint(mark));
    put(controlMarkBefore, before(controlMark));
    if (allocates == 0) return;
    put(controlRequested, requested);
    put(controlBorn, born);
    put(controlLost, counted(before(controlLost), requested - born));
    put(controlBornEver, counted(before(controlBornEver), born));
}
#endif

void main()
{
    ivec2 own = ivec2(gl_FragCoord.xy);
    now = texelFetch(control, own, 0);
    first = own.y * controlWords + own.x * 4 - controlBase;
    if (first >= 0 && first < controlWords) {
#ifdef DEATHS
        put(controlDeaths, bitsInAll());
#elif defined(CUTS)
        put(controlLost, counted(before(controlLost), uint(items) - bitsInAll()));
#else
        putBirths();
#endif
    }
    words = now;
}
