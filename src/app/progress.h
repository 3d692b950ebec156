// A progress bar on a terminal, plain lines elsewhere (every tenth). On standard error: reports stay clean.
#pragma once

#include <chrono>
#include <string>

namespace shoal::app {

class Progress {
  public:
    Progress(std::string what, int total);
    ~Progress();
    void step();
    void rename(std::string what);  // the rest of the same whole is something else

  private:
    void print();

    std::string what_;
    int total_, done_ = 0, printedTenth_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_, printed_;
};

}  // namespace shoal::app
