// An activity is what the program is busy with: BusyWatch (run/progress.h) tells those that take long.
#pragma once

#include <chrono>
#include <string>
#include <utility>

namespace shoal {

// The program does what the text says ("reading leaf.obj") while this lives.
class Activity {
  public:
    explicit Activity(std::string what);
    ~Activity();
    Activity(const Activity&) = delete;
    Activity& operator=(const Activity&) = delete;

  private:
    std::string outer_;
    std::chrono::steady_clock::time_point outerBegan_;
};

// Returns what the innermost Activity says and how long it has gone on, in s, for any thread to ask; empty:
// there is none.
std::pair<std::string, double> activity();

}  // namespace shoal
