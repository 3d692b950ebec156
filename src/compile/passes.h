// The passes of the ping-pong path (simulate/ping_pong.h) that a group needs, and why. Pure functions.
#pragma once

#include <string>
#include <vector>

namespace shoal {

struct GroupPlan;

enum class PassKind { records, normals, thrust, restore, advect, stage, collide, watch };
const char* name(PassKind kind);

struct Pass {
    PassKind kind;
    enum class When { frameStart, substep, frameEnd } when;
    std::string why;  // for people
};

// In the order of a frame, in which those of a substep repeat.
std::vector<Pass> passesOf(const GroupPlan& group);
// Whether what the springs accelerate a vertex by is kept from one pass to others.
bool keepsAcceleration(const GroupPlan& group);

}  // namespace shoal
