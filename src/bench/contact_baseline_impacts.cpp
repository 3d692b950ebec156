#include "bench/contact_baseline_impacts.h"

#include <atomic>
#include <tuple>

namespace shoal::bench {

using glm::vec3;

vec3 withinFriction(const vec3& impulse, const vec3& normal, float friction, bool& sticks) {
    const float along = glm::dot(impulse, normal), most = friction * std::max(along, 0.0f);
    const vec3 across = impulse - normal * along;
    const float squared = glm::dot(across, across);
    sticks = along >= 0 && squared <= most * most;
    if (sticks) return impulse;
    return normal * std::max(along, 0.0f) + across * (most / std::max(std::sqrt(squared), 1e-30f));
}

void ContactImpacts::begin(int slot, int sphere, std::span<const int> touching, float stepTime) {
    Slot& own = slots_[size_t(slot)];
    own.sphere = sphere;
    own.touching = touching;
    own.due = 1;
    own.chosenIn = 0;
    own.straight = stepTime;
    own.hits.clear();
    own.impulse = own.shift = vec3(0);
}

ContactImpacts::Impact ContactImpacts::impactOf(int slot, int other, float restSpeed) const {
    const BaselineSphere &a = spheres[size_t(slot)], &b = spheres[size_t(other)];
    float time = slots_[size_t(slot)].straight;
    if (b.weight > 0) time = std::min(time, slots_[size_t(other)].straight);
    const vec3 u = a.velocity - b.velocity, start = a.place - b.place - u * time;
    const float along = glm::dot(start, u), gap = glm::dot(start, start) - reach_ * reach_;
    const float under = along * along - glm::dot(u, u) * gap;
    if (along >= 0 || under <= 0) return {};
    const float wait = gap > 0 ? gap / std::max(std::sqrt(under) - along, 1e-30f) : 0;
    const vec3 touch = start + u * wait;
    const float apart = glm::length(touch);
    const vec3 normal = apart > 1e-6f * reach_ ? touch / apart : vec3(0, slot < other ? 1.0f : -1.0f, 0);
    const float speed = glm::dot(normal, u);
    if (wait > time || speed >= -restSpeed) return {};
    return {other, time - wait, speed, normal};
}

bool ContactImpacts::isBefore(const Impact& a, const Impact& b, int slot) const {
    const int own = slots_[size_t(slot)].sphere;
    const auto order = [&](const Impact& impact) {
        const int other = slots_[size_t(impact.other)].sphere;
        return std::tuple(-impact.since, impact.speed, std::min(own, other), std::max(own, other));
    };
    return order(a) < order(b);
}

bool ContactImpacts::haveMet(int slot, int other) const {
    const auto wasLast = [&](int a, int b) {
        const std::vector<int>& hits = slots_[size_t(a)].hits;
        return spheres[size_t(a)].weight <= 0 || (!hits.empty() && hits.back() == b);
    };
    return wasLast(slot, other) && wasLast(other, slot);
}

void ContactImpacts::push(int slot, int other, const vec3& impulse, float since) {
    BaselineSphere& sphere = spheres[size_t(slot)];
    Slot& own = slots_[size_t(slot)];
    sphere.velocity += impulse * sphere.weight;
    sphere.place += impulse * (sphere.weight * since);
    own.impulse += impulse;
    own.shift += impulse * since;
    own.straight = since;
    own.hits.push_back(other);
}

// Threads may store the same at once.
void ContactImpacts::chooseAnew(int slot, uint32_t round) {
    Slot& own = slots_[size_t(slot)];
    if (own.touching.size() < 2) return;
    std::atomic_ref(own.due).store(round + 1, std::memory_order_relaxed);
    for (const int other : own.touching)
        std::atomic_ref(slots_[size_t(other)].due).store(round + 1, std::memory_order_relaxed);
}

void ContactImpacts::strike(int slot, uint32_t round, const ContactBaselineStep& step) {
    Slot& own = slots_[size_t(slot)];
    const Impact impact = own.choice;
    if (own.chosenIn != round || impact.other < 0) return;
    const bool moves = spheres[size_t(impact.other)].weight > 0;
    const Slot& other = slots_[size_t(impact.other)];
    if (moves && (other.chosenIn != round || other.choice.other != slot)) {
        std::atomic_ref(own.due).store(round + 1, std::memory_order_relaxed);
        return;
    }
    if (moves && slot > impact.other) return;
    const BaselineSphere &a = spheres[size_t(slot)], &b = spheres[size_t(impact.other)];
    const vec3 u = a.velocity - b.velocity, n = impact.normal;
    const vec3 wanted =
        (n * (-(1 + step.restitution) * impact.speed) - (u - n * impact.speed)) / (a.weight + b.weight);
    bool sticks = false;
    const vec3 impulse = withinFriction(wanted, n, step.friction, sticks);
    push(slot, impact.other, impulse, impact.since);
    if (moves) push(impact.other, slot, -impulse, impact.since);
    chooseAnew(slot, round);
    if (moves) chooseAnew(impact.other, round);
}

}  // namespace shoal::bench
