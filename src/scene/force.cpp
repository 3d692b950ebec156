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

double fastestRate(const Force& force) {
    double factor = 1;
    if (force.path)
        for (const ForcePath::Keyframe& frame : force.path->keyframes)
            factor = std::max(factor, std::abs(frame.factor));
    if (const auto* attract = std::get_if<AttractForce>(&force.shape)) {
        const double strength = std::abs(attract->strength) * factor;
        const bool constant = attract->falloff == AttractForce::Falloff::constant;
        // the steepest place: the radius, or where the bound is reached
        const double pull = constant ? strength : attract->most;
        const double near = constant ? attract->radius : std::sqrt(strength / attract->most);
        return near > 0 ? std::sqrt(2 * pull / near) : 0;
    }
    if (const auto* line = std::get_if<VortexLineForce>(&force.shape))
        return std::sqrt(factor * std::max(std::abs(line->pull), std::abs(line->turn)) / line->core);
    if (const auto* thrust = std::get_if<ThrustForce>(&force.shape)) return factor * std::abs(thrust->rate);
    return 0;
}

bool actsOn(const Force& force, const std::string& group) {
    return force.groups.empty() ||
           std::find(force.groups.begin(), force.groups.end(), group) != force.groups.end();
}

}  // namespace shoal
