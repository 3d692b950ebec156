// Rest (shaders/contact/rest): which molecules stay where they are and cost nothing more. What wakes one is
// an impact (simulate/contact/finder.h), another load, or a force.
//
//   load_change   what resting molecules are pushed with, by what is awake
//   rest          which molecules come to rest, stay there, or wake
#pragma once

#include <vector>

#include "simulate/contact/data.h"

namespace shoal {

class ContactRest {
  public:
    explicit ContactRest(ContactData& data);
    // Before the step of all groups.
    void begin(const Frame& frame);
    void run(const ContactStep& times);
    bool wakes() const { return wakes_; }  // all that rests, in this step
    // Whether what rests is stepped as well, in vain, to see whether it would move.
    bool probes(size_t group) const { return groups_[group].probes; }

  private:
    struct Group {
        gpu::Program rest;
        // All that acts on its molecules beside contact, and whether it is other than in the last step.
        std::vector<glm::vec4> numbers;
        bool probes = false;
    };
    float wakeSpeed(const ContactStep& times) const;

    ContactData* data_;
    std::vector<Group> groups_;
    gpu::Program loadChange_;
    bool wakes_ = false;
};

}  // namespace shoal
