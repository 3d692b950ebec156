// What the commands of `shoal bench` share.
#pragma once

#include <optional>
#include <vector>

#include "app/line/options.h"
#include "bench/reports.h"
#include "run/progress.h"

namespace shoal::app {

// A benchmark runs in a session: its options, context and time. Each group of cases takes the seconds that
// the options say, or the usual ones.
struct BenchSession {
    BenchSession(const Options& options, double usual, double quick);
    // The last of it, once all was measured: counts the pinned threads, tells warnings.
    void end();

    measure::Clock::time_point start = measure::Clock::now();
    gpu::Context context;
    double contextSeconds;  // to make it
    bench::MeasuredOn machine;
    bench::BenchDevice device;
    measure::Schedule schedule;
    std::optional<double> mostSeconds = {};  // of all groups: with --quick, unless --seconds says otherwise
};

// One bar for a whole run, whose end is estimated anew with every step; first it tells how long that is.
class WholeRun {
  public:
    // `parts`: seconds that each is expected to take; `most`: that all of them may.
    explicit WholeRun(std::vector<double> parts, std::optional<double> most = {});
    // Whether the next part ends in time, at the pace of those before.
    bool fits() const;
    void tell(double share);  // of this part that is done
    void next();              // the part is done
    void leaveOut() { parts_[size_t(part_++)] = 0; }
    void end() { bar_->reach(100); }
    double elapsed() const { return measure::secondsSince(start_); }

  private:
    std::vector<double> parts_;
    std::optional<double> most_;
    double expected_ = 0;  // s, of the parts that are done
    ptrdiff_t part_ = 0;
    std::optional<Progress> bar_;
    measure::Clock::time_point start_ = measure::Clock::now();
};

// Measures what `--only` asks for. Error: nothing is called so.
bench::BenchReport measureSpeeds(const Options& options, BenchSession& session);
bool hasSpeeds(const Options& options);  // whether something is

}  // namespace shoal::app
