// Schedules births: those of a frame are a few runs, each of one emitter, evenly spaced or at random within
// an interval, so that the moment of a birth does not depend on the frames.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/emitter.h"

namespace shoal {

// Holds an emitter's state between frames.
struct BirthClock {
    double due = 0;     // in [0, 1): share of the next birth that has passed
    uint64_t born = 0;  // so far, with those that found no place

    bool operator==(const BirthClock&) const = default;
};

// Birth j in [0, count) is number `ordinal + j` of its emitter, at time first + interval (j / each), or where
// `random` anywhere in [first, first + interval).
struct BirthRun {
    int emitter = 0;
    uint64_t ordinal = 0;
    int count = 0, each = 1;
    double first = 0, interval = 0;  // s
    bool random = false;
};

// At most so many in a run: as many as a group can hold.
constexpr int mostInRun = 1 << 30;

// The runs of emitter number `index` in [from, to), after which its clock stands at `to`. None for emitters
// from deaths.
void addRuns(const Emitter& emitter, int index, uint32_t seed, double from, double to, BirthClock& clock,
             std::vector<BirthRun>& runs);

// At most so many runs in a frame.
int mostRuns(const Lifecycle& life);

}  // namespace shoal
