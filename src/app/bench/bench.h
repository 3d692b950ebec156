// The reports of `shoal bench`, as tables, plain sentences, or JSON, and what its commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/line/options.h"
#include "app/run/report.h"
#include "bench/bench.h"
#include "bench/collide.h"
#include "bench/particles.h"
#include "run/progress.h"

namespace shoal::app {

constexpr int pictureWidth = 640, pictureHeight = 360;

// A benchmark runs in a session: its options, context and time. Each group of cases takes the seconds that
// the options say, or the usual ones.
struct BenchSession {
    BenchSession(const Options& options, double usual, double quick);
    // The last of it, once all was measured: counts the pinned threads, tells warnings.
    void end();

    measure::Clock::time_point start = measure::Clock::now();
    gpu::Context context;
    double contextSeconds;  // to make it
    MeasuredOn machine;
    bench::BenchDevice device;
    measure::Schedule schedule;
};

// One bar for a whole run, whose end is estimated anew with every step; first it tells how long that is.
class WholeRun {
  public:
    // `parts`: seconds that each is expected to take.
    explicit WholeRun(std::vector<double> parts);
    void tell(double share);  // of this part that is done
    void next() { ++part_; }
    void end() { bar_->reach(100); }
    double elapsed() const { return measure::secondsSince(start_); }

  private:
    std::vector<double> parts_;
    ptrdiff_t part_ = 0;
    std::optional<Progress> bar_;
    measure::Clock::time_point start_ = measure::Clock::now();
};

JsonValue asJson(const std::vector<bench::Target>& targets);
// The table of the targets in a report's JSON; without `whole` of those that were measured.
std::string targetText(const JsonValue& report, bool whole = true);

struct BenchReport {
    MeasuredOn machine;
    bool quick = false;
    bool whole = true;  // everything was asked for
    double secondsAGroup = 0;
    double seconds = 0;         // the whole run
    double contextSeconds = 0;  // to make the context
    std::vector<bench::BenchResult> results;
    std::vector<bench::BenchError> errors;
    std::vector<bench::StartTime> starts;
    std::vector<bench::PassTable> passes;
};

// Measures what `--only` asks for. Error: nothing is called so.
BenchReport measureSpeeds(const Options& options, BenchSession& session);
bool hasSpeeds(const Options& options);  // whether something is

std::string asText(const BenchReport& report);
JsonValue asJson(const BenchReport& report);

struct CollideReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ContactTimes> contact;
    std::optional<bench::SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

struct ParticleReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ParticleTimes> times;
};

std::string asText(const ParticleReport& report);
JsonValue asJson(const ParticleReport& report);

}  // namespace shoal::app
