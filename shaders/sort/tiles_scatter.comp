// Radix sort by tiles: sorts each workgroup's tile by the digit in shared memory, then moves its runs of equal digits
// to their places, neighbours beside neighbours.
//
// The tile is sorted by the digit's low 4 bits, then by its high ones, each time stably: a lane takes PER_LANE pairs
// that follow one another and counts them in 16 counters of its own, two in a word; adding the counters up, digit by
// digit and lane by lane within, gives every pair its place.
#include "sort/digit.glsl"
#include "sort/group_scan.glsl"

layout(local_size_x = LANES) in;

uniform int count, parts;

layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer Totals { uint totals[]; };
layout(std430) writeonly buffer Sorted { uvec2 sorted[]; };
layout(std430) readonly buffer Pairs { uvec2 pairs[]; };

const int PER_LANE = TILE_PAIRS / LANES, WORDS = 8;

shared uvec2 tile[TILE_PAIRS];
shared uint counters[WORDS * LANES];  // word w of a lane: 4-bit digit w in its low half, w + 8 in its high half
shared uint moved[LANES];             // of each digit: from the place in the tile to the place in the result

void sumCounters(int lane)
{
    uint sum = 0u;
    for (int k = 0; k < WORDS; ++k) sum += counters[lane * WORDS + k];
    uint total;
    uint before = sumBefore(sum, total);
    before += total << 16;  // digits 8 to 15 come after 0 to 7
    for (int k = 0; k < WORDS; ++k) {
        uint here = counters[lane * WORDS + k];
        counters[lane * WORDS + k] = before;
        before += here;
    }
}

void sortTile(int lane, int nibble)
{
    uvec2 own[PER_LANE];
    uint before[PER_LANE];  // pairs of the same 4-bit digit that the lane has before this one
    for (int w = 0; w < WORDS; ++w) counters[w * LANES + lane] = 0u;
    for (int k = 0; k < PER_LANE; ++k) {
        own[k] = tile[lane * PER_LANE + k];
        uint d = (digitOf(own[k].x) >> nibble) & 15u;
        uint word = (d & 7u) * LANES + lane, low = (d >> 3) * 16u;
        before[k] = (counters[word] >> low) & 0xffffu;
        counters[word] += 1u << low;
    }
    waitForGroup();
    sumCounters(lane);
    waitForGroup();
    for (int k = 0; k < PER_LANE; ++k) {
        uint d = (digitOf(own[k].x) >> nibble) & 15u;
        uint first = (counters[(d & 7u) * LANES + lane] >> ((d >> 3) * 16u)) & 0xffffu;
        tile[first + before[k]] = own[k];
    }
    waitForGroup();
}

void main()
{
    int lane = int(gl_LocalInvocationID.x), part = int(gl_WorkGroupID.x);
    int first = part * TILE_PAIRS, size = min(TILE_PAIRS, count - first);
    // The padding of the last tile has the greatest digit and stays behind all pairs.
    for (int i = lane; i < TILE_PAIRS; i += LANES) tile[i] = i < size ? pairs[first + i] : uvec2(0xffffffffu);
    waitForGroup();
    sortTile(lane, 0);
    if (digits > 16) sortTile(lane, 4);

    uint total;
    uint smaller = sumBefore(lane < digits ? totals[lane] : 0u, total);
    if (lane < digits) moved[lane] = smaller + counts[lane * parts + part];
    waitForGroup();
    for (int i = lane; i < size; i += LANES) {
        uint d = digitOf(tile[i].x);
        if (i == 0 || digitOf(tile[i - 1].x) != d) moved[d] -= uint(i);  // the one lane where the run begins
    }
    waitForGroup();
    for (int i = lane; i < size; i += LANES) sorted[moved[digitOf(tile[i].x)] + uint(i)] = tile[i];
}
