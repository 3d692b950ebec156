#include "compile/moving_colliders.h"

#include <algorithm>

#include "compile/pack.h"

namespace shoal {

static glm::vec4 asVector(const glm::dquat& q) {
    return glm::vec4(glm::dvec4(q.x, q.y, q.z, q.w));
}

void setPoses(std::vector<glm::vec4>& parameters, const std::vector<MovingCollider>& moving,
              std::optional<size_t> fastest, double time, double duration) {
    double most = 0;
    for (const MovingCollider& collider : moving) {
        const Pose from = poseAt(collider.path, time);
        Pose to = poseAt(collider.path, time + duration);
        if (glm::dot(from.rotation, to.rotation) < 0) to.rotation = -to.rotation;
        const Motion motion = motionBetween(from, to, duration);
        glm::vec4* const out = &parameters[collider.slot];
        const SplitPoint position = splitPoint(from.position);
        out[0] = glm::vec4(glm::vec3(position.lattice), 0);
        out[1] = glm::vec4(glm::vec3(position.rest), 0);
        out[2] = glm::vec4(glm::vec3(motion.velocity), 0);
        if (collider.turns) {
            out[3] = asVector(from.rotation);
            out[4] = asVector(to.rotation);
            out[5] = glm::vec4(glm::vec3(motion.spin), float(1 / duration));
        }
        // the normalised straight way turns faster in its middle, by less than this within mostTurn
        if (collider.swept)
            most = std::max(most,
                            glm::length(motion.velocity) + 1.1 * glm::length(motion.spin) * collider.reach);
    }
    if (fastest) parameters[*fastest] = glm::vec4(float(most), 0, 0, 0);
}

}  // namespace shoal
