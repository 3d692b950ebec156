// Paths along keyframes: there are at least two, whose times rise.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/where.h"

namespace shoal {

// Error: at the keyframe, or at the key "keyframes" of `where`.
template <typename Keyframe>
void checkKeyframes(const std::vector<Keyframe>& keyframes, const Where& where) {
    if (keyframes.size() < 2)
        throw Error(where.locate("keyframes"), "expected at least two keyframes, found ", keyframes.size());
    for (size_t i = 1; i < keyframes.size(); ++i)
        if (const double before = keyframes[i - 1].time; !(keyframes[i].time > before))
            throw Error(where.in("keyframes", i).locate("time"),
                        "expected a time after that of the keyframe before, ", before, " s, found ",
                        keyframes[i].time);
}

// The two keyframes that a time lies between, and which share of the way from one to the other it is. Before
// the first and after the last, where it does not repeat, both are the same.
template <typename Keyframe>
struct Between {
    const Keyframe &a, &b;
    double share = 0;
};

template <typename Keyframe>
Between<Keyframe> between(const std::vector<Keyframe>& keyframes, bool repeats, double time) {
    const Keyframe &first = keyframes.front(), &last = keyframes.back();
    if (repeats && time > first.time) {
        const double period = last.time - first.time, since = time - first.time;
        time = first.time + since - period * std::floor(since / period);
    }
    if (!(time > first.time)) return {first, first};  // also of no number
    if (time >= last.time) return {last, last};
    const auto next = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                       [](double t, const Keyframe& k) { return t < k.time; });
    const Keyframe &a = *(next - 1), &b = *next;
    return {a, b, (time - a.time) / (b.time - a.time)};
}

}  // namespace shoal
