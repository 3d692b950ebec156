#include "scene/collider_path.h"

#include <algorithm>
#include <cmath>

namespace shoal {

static double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = b * glm::conjugate(a);
    return 2 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

bool ColliderPath::turns() const {
    return std::any_of(keyframes.begin(), keyframes.end(), [](const Keyframe& frame) {
        return angleBetween({1, 0, 0, 0}, frame.pose.rotation) > 0;
    });
}

double ColliderPath::fastestTurn() const {
    double fastest = 0;
    for (size_t i = 1; i < keyframes.size(); ++i) {
        const double angle = angleBetween(keyframes[i - 1].pose.rotation, keyframes[i].pose.rotation);
        fastest = std::max(fastest, angle / (keyframes[i].time - keyframes[i - 1].time));
    }
    return smooth ? 1.5 * fastest : fastest;  // the steepest of 3 s^2 - 2 s^3
}

Pose poseAt(const ColliderPath& path, double time) {
    if (path.repeats) {
        const double period = path.end() - path.begin(), since = time - path.begin();
        if (since > 0) time = path.begin() + since - period * std::floor(since / period);
    }
    if (time <= path.begin()) return path.keyframes.front().pose;
    if (time >= path.end()) return path.keyframes.back().pose;
    const auto next = std::upper_bound(path.keyframes.begin(), path.keyframes.end(), time,
                                       [](double t, const ColliderPath::Keyframe& k) { return t < k.time; });
    const auto& a = *(next - 1);
    const auto& b = *next;
    double s = (time - a.time) / (b.time - a.time);
    if (path.smooth) s = s * s * (3 - 2 * s);
    return {glm::mix(a.pose.position, b.pose.position, s), glm::slerp(a.pose.rotation, b.pose.rotation, s)};
}

Motion motionBetween(const Pose& from, const Pose& to, double duration) {
    glm::dquat turn = to.rotation * glm::conjugate(from.rotation);
    if (turn.w < 0) turn = -turn;
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    const glm::dvec3 angle = sine > 1e-12 ? axis * (2 * std::atan2(sine, turn.w) / sine) : 2.0 * axis;
    return {(to.position - from.position) / duration, angle / duration};
}

}  // namespace shoal
