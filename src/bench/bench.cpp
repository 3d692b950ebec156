#include "bench/bench.h"

#include <algorithm>
#include <cmath>

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

// The frames that a visit times, after a restart and one frame that is not timed, so that caches are as in a
// run of one case. Slow frames do without that one and are timed one by one: five frames of a fall differ by
// little, and any two samples of a case by nothing.
constexpr int framesTimed = 4;
constexpr double slowFrameSeconds = 0.1;

class Entrant {
  public:
    Entrant(const BenchCase& one, const Molecule& molecule, const BenchStart& start,
            const BenchDevice& device)
        : runner_(makeRunner(one, molecule, start, device)), context_(*device.context) {
        result.one = one;
        result.stateBytes = runner_->stateBytes;
        result.movedBytes = runner_->movedBytes;
        result.operations = runner_->operations;
        result.lanes = runner_->lanes;
    }

    // Not counted: compiles, touches memory; then a first look at what a frame and a visit cost.
    void warmUp() {
        runner_->restart();
        runner_->frame();
        runner_->finish();
        const Clock::time_point start = Clock::now();
        slow_ = timed(1) > slowFrameSeconds;
        result.framesPerSample = slow_ ? 1 : framesTimed;
        visit();
        seconds = secondsSince(start) * (slow_ ? 0.5 : double(framesTimed + 1) / (framesTimed + 2));
        samples_.clear();
    }

    void visit() {
        runner_->restart();
        if (!slow_) runner_->frame();
        runner_->finish();
        samples_.push_back(timed(result.framesPerSample));
    }

    BenchResult finish() {
        result.frame = measure::spreadOf(samples_);
        if (timedFrames_ > 0) result.busStateBytes = double(busBytes_) / double(timedFrames_);
        return result;
    }

    BenchResult result;
    double seconds = 0;  // of a visit

  private:
    // Seconds a frame.
    double timed(int frames) {
        const uint64_t before = context_.traffic().total(gpu::Traffic::Kind::state);
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < frames; ++i)
            runner_->frame();
        runner_->finish();
        const double out = secondsSince(start) / frames;
        busBytes_ += context_.traffic().total(gpu::Traffic::Kind::state) - before;
        timedFrames_ += frames;
        return out;
    }

    std::unique_ptr<BenchRunner> runner_;
    gpu::Context& context_;
    bool slow_ = false;
    int64_t timedFrames_ = 0;
    uint64_t busBytes_ = 0;
    std::vector<double> samples_;  // s a frame
};

}  // namespace

std::vector<BenchResult> measureGroup(const std::vector<BenchCase>& cases, const BenchMolecules& molecules,
                                      const BenchDevice& device, const measure::Schedule& schedule,
                                      const BenchProgress& progress) {
    const Molecule& molecule = molecules.of(cases.front().molecule);
    const BenchStart start(cases.front(), molecule, device.cores);
    std::vector<BenchResult> out;
    std::vector<std::unique_ptr<Entrant>> entrants;
    std::vector<size_t> places;  // of the entrants in `out`
    std::vector<double> cost;
    for (const BenchCase& one : cases) {
        progress(one.name(), schedule.seconds);
        BenchResult& result = out.emplace_back();
        result.one = one;
        result.leftOut = reasonToLeaveOut(one, molecule, device);
        if (!result.leftOut.empty()) continue;
        try {
            entrants.push_back(std::make_unique<Entrant>(one, molecule, start, device));
        } catch (const gpu::OutOfMemory& error) {
            result.leftOut = error.message();
            continue;
        }
        measure::pinRasteriserThreads();
        entrants.back()->warmUp();
        places.push_back(out.size() - 1);
        cost.push_back(entrants.back()->seconds);
    }
    const measure::VisitPlan plan = measure::planVisits(cost, schedule);
    double left = plan.seconds;
    measure::takeTurns(plan, [&](size_t i) {
        entrants[i]->visit();
        left = std::max(0.0, left - cost[i]);
        progress(cases.front().group, left);
    });
    for (size_t i = 0; i < entrants.size(); ++i)
        out[places[i]] = entrants[i]->finish();
    device.context->checkErrors("bench");
    return out;
}

std::vector<std::vector<BenchCase>> byGroup(const std::vector<BenchCase>& cases) {
    std::vector<std::vector<BenchCase>> out;
    for (const BenchCase& one : cases) {
        if (out.empty() || out.back().front().group != one.group) out.emplace_back();
        out.back().push_back(one);
    }
    return out;
}

}  // namespace shoal::bench
