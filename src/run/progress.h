// Progress and warnings for a user who waits, on standard error, so that reports on standard output stay
// clean.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/activity.h"
#include "core/error.h"

namespace shoal {

// How long the rest of a work takes, by its last steps alone: what was slow before is over, and what is slow
// now goes on.
class TimeLeft {
  public:
    void reach(int done, double time);  // steps, each time more; s
    double seconds(int total) const;    // of the steps that are left; 0: not known yet

  private:
    std::deque<std::pair<int, double>> last_;  // steps and when they were done
};

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
    std::chrono::steady_clock::time_point start_, printed_;
    TimeLeft left_;
};

// Returns what the program waits for: a driver that compiles, with about how long that takes in all where it
// is known, or else an Activity.
Busy busyWith();

// Tells, each once, what has been going on for so long while this lives, with a bar on a terminal where it is
// known how long it takes.
class BusyWatch {
  public:
    explicit BusyWatch(std::function<void(const std::string&)> tell = say,
                       std::chrono::milliseconds patience = std::chrono::seconds(2));
    ~BusyWatch();
    BusyWatch(const BusyWatch&) = delete;
    BusyWatch& operator=(const BusyWatch&) = delete;

  private:
    static void say(const std::string& what);  // on stderr
    void show(const Busy& busy);
    void watch();

    std::function<void(const std::string&)> tell_;
    std::chrono::milliseconds patience_;
    std::set<std::string> told_;
    std::optional<Progress> bar_;  // of what goes on
    int percent_ = 0;              // of it
    std::string barOf_;
    std::mutex guard_;
    std::condition_variable end_;
    bool ends_ = false;
    std::thread thread_;
};

// "3 s", "12 minutes": an estimate for people.
std::string roughly(double seconds);

void tellWarnings(const std::vector<Warning>& warnings);

}  // namespace shoal
