// Colliders that a path moves: their poses as parameters of the generated text, renewed every frame, so that
// nothing compiles.
//
// Over a frame a pose moves at a constant velocity and turns by the normalised straight way between two
// quaternions, from the path's pose at its start to that at its end: exact at both ends. Between them a
// collider that turns by an angle a within a frame is off by at most a^3 / 246 of its reach, and a bend of
// the path within a frame is cut.
//
// Parameters of one, from its slot: position at the frame's start (SplitPoint) | velocity (m/s); if it turns
// quaternion at the start | at the end | angular velocity (rad/s), 1 / duration of the frame.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "scene/collider_path.h"

namespace shoal {

struct MovingCollider {
    ColliderPath path;
    size_t slot = 0;  // of its parameters
    bool turns = false;
    bool swept = false;  // looked for along a vertex's way
    double reach = 0;    // m, of its surface from the origin of its frame; of swept ones
};

constexpr double mostTurn = 1;  // rad within a frame

// `fastest`: slot of the number that no surface of the swept ones moves faster than, m/s.
void setPoses(std::vector<glm::vec4>& parameters, const std::vector<MovingCollider>& moving,
              std::optional<size_t> fastest, double time, double duration);

}  // namespace shoal
