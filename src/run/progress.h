// Progress and warnings for a user who waits, on standard error, so that reports on standard output stay
// clean.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "geometry/distance_field.h"

namespace shoal {

// A bar on a terminal, plain lines elsewhere (every tenth).
class Progress {
  public:
    Progress(const std::string& what, int total);
    ~Progress();
    void step() { reach(done_ + 1); }
    void reach(int done);           // unless it is further already
    void rename(std::string what);  // the rest of the same whole is something else

  private:
    void print();

    std::string what_;
    int total_, done_ = 0, printedTenth_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_, firstDone_, printed_;
};

// Shows the baking of distance fields when it takes long.
class FieldWatch {
  public:
    // For readScene, while this lives: from the cache's own folder.
    FieldBaking baking();

  private:
    void show(double share);

    std::optional<Progress> bar_;
    int last_ = 0;  // hundredths
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Tells, of each program once, its label, while this lives and the driver has been compiling it for so long.
class CompilingWatch {
  public:
    explicit CompilingWatch(std::function<void(const std::string&)> tell = sayThatItCompiles,
                            std::chrono::milliseconds patience = std::chrono::seconds(2));
    ~CompilingWatch();
    CompilingWatch(const CompilingWatch&) = delete;
    CompilingWatch& operator=(const CompilingWatch&) = delete;

  private:
    static void sayThatItCompiles(const std::string& label);  // on stderr
    void watch();

    std::function<void(const std::string&)> tell_;
    std::chrono::milliseconds patience_;
    std::mutex guard_;
    std::condition_variable end_;
    bool ends_ = false;
    std::thread thread_;
};

// "3 s", "12 minutes": an estimate for people.
std::string roughly(double seconds);

void tellWarnings(const std::vector<Warning>& warnings);

}  // namespace shoal
