// An activity is what the program is busy with: BusyWatch (run/progress.h) and the windows tell those that
// take long.
#pragma once

#include <chrono>
#include <string>

namespace shoal {

// What the program waits for.
struct Busy {
    std::string what;    // empty: nothing
    double seconds = 0;  // so far
    double share = 0;    // of it that is done, about; 0: not known
};

// The program does what the text says ("reading leaf.obj") while this lives.
class Activity {
  public:
    explicit Activity(std::string what);
    ~Activity();
    Activity(const Activity&) = delete;
    Activity& operator=(const Activity&) = delete;

    static void reach(double share);  // of the innermost activity

  private:
    Busy outer_;
    std::chrono::steady_clock::time_point outerBegan_;
};

// Returns the innermost activity, for any thread to ask.
Busy activity();

}  // namespace shoal
