// An activity is what the program is busy with: BusyWatch (run/progress.h) tells those that take long.
#pragma once

#include <string>

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
};

// Returns what the innermost Activity says, for any thread to ask; empty: there is none.
std::string activity();

}  // namespace shoal
