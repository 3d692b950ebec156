// The motion of a collider: poses at moments, and what lies between them.
#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace shoal {

// A rigid motion: x becomes rotation x + position.
struct Pose {
    glm::dvec3 position{0};  // m
    glm::dquat rotation{1, 0, 0, 0};
};

// Poses of the frame in which a collider's shape is given.
struct ColliderPath {
    struct Keyframe {
        double time = 0;  // s
        Pose pose;
    };
    std::vector<Keyframe> keyframes;  // at least two; their times rise; neighbours' rotations are within pi
    bool repeats = false;  // from the first after the last, whose poses are the same; else it holds
    bool smooth = false;   // eased, at rest at every keyframe; else at a constant velocity between two

    bool turns() const;          // some rotation is not the identity
    double fastestTurn() const;  // rad/s
};

class Description;
const Description& describe(const ColliderPath::Keyframe*);
const Description& describe(const ColliderPath*);

Pose poseAt(const ColliderPath& path, double time);

// From one pose to another in a time: constant velocities, m/s and rad/s about the moving origin.
struct Motion {
    glm::dvec3 velocity{0}, spin{0};
};
Motion motionBetween(const Pose& from, const Pose& to, double duration);

}  // namespace shoal
