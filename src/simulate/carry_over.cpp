#include "simulate/carry_over.h"

#include <algorithm>
#include <limits>

#include "simulate/checkpoint_head.h"

namespace shoal {

namespace {

template <typename T>
void overwrite(std::vector<T>& values, const std::vector<T>& others) {
    std::copy_n(others.begin(), std::min(values.size(), others.size()), values.begin());
}

// Carries over an allocator on the CPU, which has `ends`: those of the old one, else the end of each life.
void carryBook(const GroupState& saved, double time, GroupState& out) {
    for (size_t m = 0; m < out.ends.size(); ++m) {
        const glm::vec2& life = out.lives[m];
        const double own =
            life.y > 0 ? time + double(life.y - life.x) : -std::numeric_limits<double>::infinity();
        out.ends[m] = m < saved.ends.size() ? saved.ends[m] : own;
    }
    // the order in which places were freed; without it, the first ones come first
    if (saved.freed.size() == out.freed.size())
        out.freed = saved.freed;
    else
        out.freed.clear();
}

// Carries over what every molecule has, whatever the solver. A solver's history goes along only to the same
// solver and count; else it begins anew.
GroupState moved(const GroupState& saved, const GroupPlan& from, const GroupPlan& to) {
    GroupState out = to.start;
    overwrite(out.positions, saved.positions);
    overwrite(out.velocities, saved.velocities);
    overwrite(out.anchors, saved.anchors);
    overwrite(out.released, saved.released);
    overwrite(out.steering, saved.steering);
    if (from.solver != to.solver || from.count != to.count) return out;
    out.displacements = saved.displacements;
    out.velocityChanges = saved.velocityChanges;
    return out;
}

// Returns a group's state on the other plan, in which new places have that plan's start.
GroupState carried(const GroupState& saved, double time, const GroupPlan& from, const GroupPlan& to) {
    GroupState out = moved(saved, from, to);
    if (!to.life) return out;
    std::fill(out.lives.begin(), out.lives.end(), glm::vec2(0));
    overwrite(out.lives, saved.lives);
    overwrite(out.seeds, saved.seeds);
    overwrite(out.looks, saved.looks);
    out.clocks = saved.clocks;
    out.clocks.resize(to.life->cycle.emitters.size());
    out.totals = saved.totals;
    out.totals.resize(2);
    carryBook(saved, time, out);
    return out;
}

// Returns the length of the last substep, s, from which a solver with history goes on; 0 where it starts
// anew, because forces jump.
double stepBefore(const SavedState& saved, const Plan& from, const Plan& to) {
    using checkpoint::forcesAt;
    return forcesAt(from, saved.time) == forcesAt(to, saved.time) ? saved.step : 0;
}

const GroupPlan* sameGroup(const Plan& among, const GroupPlan& group) {
    for (const GroupPlan& other : among.groups)
        if (group.name.empty() ? other.index == group.index && other.name.empty() : other.name == group.name)
            return &other;
    return nullptr;
}

}  // namespace

GoneOn goOn(const SavedState& saved, const Plan& from, const Plan& to) {
    GoneOn out{{saved.time, saved.frames, {}, stepBefore(saved, from, to), {}}, {}};
    if (from.contact.spheres == to.contact.spheres) out.state.contacts = saved.contacts;
    for (const GroupPlan& group : to.groups) {
        const GroupPlan* before = sameGroup(from, group);
        if (before && before->vertexCount == group.vertexCount &&
            before->life.has_value() == group.life.has_value()) {
            const size_t index = size_t(before - from.groups.data());
            out.state.groups.push_back(carried(saved.groups[index], saved.time, *before, group));
        } else {
            out.state.groups.push_back(group.start);
            out.restarted.push_back(group.name);
        }
    }
    return out;
}

}  // namespace shoal
