// The search of contact (shaders/contact/search): the spheres that each slot touches. Where molecules may
// rest, only what is awake, and what rests and is touched or woken, is looked at (shaders/contact/rest).
//
//   awake   lists what is awake, and marks what rests and has touched something awake
//   find    the spheres that each touches (or neighbors, UberFlow's: some of them)
//   wake    the molecules that an impact wakes; then find once more, of what is marked
#pragma once

#include "simulate/contact/data.h"

namespace shoal {

class ContactFinder {
  public:
    explicit ContactFinder(ContactData& data);
    void run(const ContactStep& times);

  private:
    void find(const gpu::Program& program, const ContactStep& times);
    void wake();

    ContactData* data_;
    gpu::Program find_, findStaggered_, findResting_, awake_, wake_;
};

}  // namespace shoal
