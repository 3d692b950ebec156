#include "scene/force.h"

#include <algorithm>
#include <cmath>

namespace shoal {

ForceMoment momentOf(const std::optional<ForcePath>& path, double time) {
    if (!path) return {};
    const auto& frames = path->keyframes;
    const double begin = frames.front().time, end = frames.back().time;
    if (path->repeats && time > begin) {
        const double period = end - begin, since = time - begin;
        time = begin + since - period * std::floor(since / period);
    }
    if (time <= begin) return {frames.front().offset, frames.front().factor};
    if (time >= end) return {frames.back().offset, frames.back().factor};
    const auto next = std::upper_bound(frames.begin(), frames.end(), time,
                                       [](double t, const ForcePath::Keyframe& k) { return t < k.time; });
    const auto& a = *(next - 1);
    const auto& b = *next;
    const double share = (time - a.time) / (b.time - a.time);
    return {glm::mix(a.offset, b.offset, share), glm::mix(a.factor, b.factor, share)};
}

bool actsOn(const Force& force, const std::string& group) {
    return force.groups.empty() ||
           std::find(force.groups.begin(), force.groups.end(), group) != force.groups.end();
}

}  // namespace shoal
