#include "scene/collider_path.h"

#include <algorithm>
#include <cmath>

#include "core/describe.h"
#include "scene/keyframes.h"

namespace shoal {

static bool same(const Pose& a, const Pose& b) {
    const double size = 1 + glm::length(a.position);
    return glm::length(a.position - b.position) < 1e-9 * size &&
           std::abs(glm::dot(a.rotation, b.rotation)) > 1 - 1e-9;
}

const Description& describe(const Pose*) {
    static const Description description =
        Describe<Pose>("pose", "A position and a rotation.")
            .key("position", &Pose::position, {"m", "Where the frame is."})
            .rotation("rotation", &Pose::rotation, {"", "How it is turned."});
    return description;
}

const Description& describe(const ColliderPath::Keyframe*) {
    using Keyframe = ColliderPath::Keyframe;
    static const Description description =
        Describe<Keyframe>("keyframe", "A moment of a path.")
            .key("time", &Keyframe::time, {"s", "The time, after that of the keyframe before."})
            .needed()
            .keysOf(&Keyframe::pose);
    return description;
}

const Description& describe(const ColliderPath*) {
    // Rotations go the short way from one to the next.
    static const auto derive = [](ColliderPath& path, const Where&) {
        for (size_t i = 1; i < path.keyframes.size(); ++i) {
            glm::dquat& rotation = path.keyframes[i].pose.rotation;
            if (glm::dot(path.keyframes[i - 1].pose.rotation, rotation) < 0) rotation = -rotation;
        }
    };
    static const auto rule = [](const ColliderPath& path, const Where& where) {
        checkKeyframes(path.keyframes, where);
        if (path.repeats && !same(path.keyframes.front().pose, path.keyframes.back().pose))
            throw Error(where.locate("keyframes"),
                        "expected the last pose to be the first again where the path repeats");
    };
    static const Description description =
        Describe<ColliderPath>("path", "Poses over time of the frame in which a shape is given.")
            .word(
                "end", &ColliderPath::repeats, {"hold", "repeat"},
                {"",
                 "Whether it stays at the last pose, or starts again at the first, which must be the same."})
            .word(
                "interpolation", &ColliderPath::smooth, {"linear", "smooth"},
                {"", "Whether it moves at constant velocities between two keyframes, or rests at every one."})
            .key("keyframes", &ColliderPath::keyframes, {"", "At least two moments, in order."})
            .needed()
            .derive(derive)
            .rule(rule, R"({"properties": {"keyframes": {"minItems": 2}}})");
    return description;
}

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
    auto [a, b, s] = between(path.keyframes, path.repeats, time);
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
