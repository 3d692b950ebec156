// The impacts of the baseline of contact (bench/contact_baseline.h), in their order, with the rounds and the
// equations of shaders/contact/response/choose.pass.glsl and strike.pass.glsl beside it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "bench/contact_baseline.h"

namespace shoal::bench {

// A sphere that touches others.
struct BaselineSphere {
    glm::vec3 place, velocity;
    float weight;  // 1/kg
};

// The impulse that Coulomb's cone leaves of one; `sticks`: all of it.
glm::vec3 withinFriction(const glm::vec3& impulse, const glm::vec3& normal, float friction, bool& sticks);

class ContactImpacts {
  public:
    ContactImpacts(size_t count, float reach) : spheres(count), reach_(reach), slots_(count) {}

    std::vector<BaselineSphere> spheres;  // by slot, set where they take part

    // Borrows the slots that it touches.
    void begin(int slot, int sphere, std::span<const int> touching, float stepTime);

    // Lets a slot choose its earliest impact in a round. isClosed(other slot, struck): whether a contact has
    // none. `round`: from 1.
    template <typename IsClosed>
    void choose(int slot, uint32_t round, float restSpeed, const IsClosed& isClosed) {
        Slot& own = slots_[size_t(slot)];
        if (own.due != round) return;
        own.choice = {};
        own.chosenIn = round;
        if (spheres[size_t(slot)].weight <= 0) return;
        for (const int other : own.touching) {
            const Impact impact = impactOf(slot, other, restSpeed);
            if (impact.other < 0 || (own.choice.other >= 0 && !isBefore(impact, own.choice, slot))) continue;
            if (!haveMet(slot, other) && !isClosed(other, isStruck(slot, other))) own.choice = impact;
        }
    }
    // An impact happens that both have chosen.
    void strike(int slot, uint32_t round, const ContactBaselineStep& step);

    bool isStruck(int slot, int other) const {
        return !slots_[size_t(slot)].hits.empty() || !slots_[size_t(other)].hits.empty();
    }
    bool hasHit(int slot, int other) const {
        const std::vector<int>& hits = slots_[size_t(slot)].hits;
        return std::find(hits.begin(), hits.end(), other) != hits.end();
    }
    const glm::vec3& impulse(int slot) const { return slots_[size_t(slot)].impulse; }  // N s
    const glm::vec3& shift(int slot) const { return slots_[size_t(slot)].shift; }      // kg m

  private:
    struct Impact {
        int other = -1;
        float since = 0, speed = 0;
        glm::vec3 normal{0};
    };
    struct Slot {
        int sphere = 0;
        std::span<const int> touching;
        uint32_t due = 0;       // the round in which it chooses next
        uint32_t chosenIn = 0;  // that in which it has chosen last
        float straight = 0;     // s, for how long it has moved straight
        std::vector<int> hits;  // slots with which it has had impacts
        glm::vec3 impulse{0}, shift{0};
        Impact choice;
    };

    Impact impactOf(int slot, int other, float restSpeed) const;
    bool isBefore(const Impact& a, const Impact& b, int slot) const;
    // Whether nothing has moved the two since their impact.
    bool haveMet(int slot, int other) const;
    void push(int slot, int other, const glm::vec3& impulse, float since);
    void chooseAnew(int slot, uint32_t round);

    float reach_;  // m
    std::vector<Slot> slots_;
};

}  // namespace shoal::bench
