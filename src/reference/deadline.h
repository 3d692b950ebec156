// Ends an integration that would take longer than its caller wants to wait.
#pragma once

#include <chrono>
#include <limits>

namespace shoal::reference {

struct OutOfTime {};  // thrown by Deadline::check, caught by solve

class Deadline {
  public:
    explicit Deadline(double seconds = std::numeric_limits<double>::infinity()) : seconds_(seconds) {}

    // Once a step.
    void check() {
        if (++calls_ % 16 == 0 && left() < 0) throw OutOfTime{};
    }
    double passed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double left() const { return seconds_ - passed(); }

  private:
    using Clock = std::chrono::steady_clock;
    double seconds_;
    Clock::time_point start_ = Clock::now();
    unsigned calls_ = 0;
};

}  // namespace shoal::reference
