// Reading the state back: for exports, tests, hashes and a change of path, never in a plain frame.
#include <bit>

#include "core/contract.h"
#include "simulate/simulation.h"

namespace shoal {

SavedState Simulation::save() const {
    SavedState out{time_, frames_, {}, forcesJump() ? 0 : lastStep_, {}};
    for (size_t g = 0; g < plan_.groups.size(); ++g)
        out.groups.push_back(path_->read(g));
    if (path_->contact()) out.contacts = path_->contact()->memory();
    return out;
}

std::optional<SavedState> Simulation::saveBefore() const {
    if (issued_.empty()) return {};
    std::optional<std::vector<GroupState>> groups = path_->readBefore();
    if (!groups) return {};
    const Issued& last = issued_.back();
    return SavedState{last.frame.time, last.frame.number, std::move(*groups), last.stepBefore, {}};
}

// Adapts the state of a scene with other pins: a pinned vertex is at rest, and pins that cannot be released
// hold.
static GroupState asHeld(const GroupPlan& group, GroupState state) {
    if (!group.needs.release) std::fill(state.released.begin(), state.released.end(), uint8_t(0));
    for (size_t i = 0; group.needs.pins && i < state.velocities.size(); ++i) {
        const size_t vertices = size_t(group.vertexCount);
        const bool held = group.pinned[i % vertices] && state.released[i / vertices] == 0;
        if (held) state.velocities[i] = glm::vec3(0);
    }
    return state;
}

void Simulation::load(const SavedState& saved) {
    EXPECTS(saved.groups.size() == plan_.groups.size() && "a state of another plan");
    for (size_t g = 0; g < plan_.groups.size(); ++g) {
        EXPECTS(saved.groups[g].positions.size() == plan_.groups[g].start.positions.size());
        path_->write(g, asHeld(plan_.groups[g], saved.groups[g]), saved.time);
    }
    path_->remember(saved.contacts);
    goOn(saved.time, saved.frames, saved.step);
}

Snapshot Simulation::snapshot(size_t index) const {
    const GroupPlan& group = plan_.groups[index];
    const GroupState state = path_->read(index);
    Snapshot out;
    out.time = time_;
    out.count = group.count;
    out.vertexCount = group.vertexCount;
    out.velocities.assign(state.velocities.begin(), state.velocities.end());
    out.positions.reserve(state.positions.size());
    const size_t vertices = size_t(group.vertexCount);
    for (size_t i = 0; i < state.positions.size(); ++i)
        out.positions.push_back(glm::dvec3(state.anchors[i / vertices]) + glm::dvec3(state.positions[i]));
    for (const glm::vec2& life : state.lives)
        out.alive.push_back(life.x < life.y);
    out.lives = state.lives;
    out.seeds = state.seeds.empty() ? group.constants.seeds : state.seeds;
    out.released.assign(state.released.begin(), state.released.end());
    out.normals.resize(state.positions.size());
    if (options_.drawn && group.needs.normals) out.normals = path_->readNormals(index);
    return out;
}

uint64_t Simulation::hash() const {
    uint64_t hash = 14695981039346656037ull;
    const auto add = [&](uint32_t bits) { hash = (hash ^ bits) * 1099511628211ull; };
    const auto addAll = [&](const auto& values) {
        for (const auto& value : values)
            for (int c = 0; c < value.length(); ++c)
                add(std::bit_cast<uint32_t>(value[c]));
    };
    for (size_t g = 0; g < plan_.groups.size(); ++g) {
        const GroupState state = path_->read(g);
        addAll(state.positions);
        addAll(state.velocities);
        addAll(state.displacements);
        addAll(state.velocityChanges);
        addAll(state.anchors);
        for (const uint8_t released : state.released)
            add(released);
        addAll(state.steering);
        addAll(state.lives);
    }
    return hash;
}

}  // namespace shoal
