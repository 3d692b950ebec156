#include "bench/bench.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

// The frames that a visit times, after a restart and one frame that is not timed, so that caches are as in a
// run of one case. Slow frames go without the untimed frame and are timed one by one. The first is timed in
// the warm-up; it is another frame than the later samples, but five frames of a fall differ little.
constexpr int framesTimed = 4;
constexpr double slowFrameSeconds = 0.1;

class FrameEntrant {
  public:
    FrameEntrant(BenchResult& result, const Molecule& molecule, const BenchStart& start,
                 const BenchDevice& device)
        : result_(result),
          runner_(makeRunner(result.benchCase, molecule, start, device)),
          context_(*device.context),
          ownTimes_(device.ownTimes && isOnDevice(result.benchCase.subject)) {
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
        const double once = timed(1);
        slow_ = once > slowFrameSeconds;
        if (slow_) {
            result_.framesPerSample = 1;
            samples_ = {once};
            seconds = secondsSince(start);
            if (ownTimes_) visitAgain();
            return;
        }
        result_.framesPerSample = framesTimed;
        visit();
        seconds = secondsSince(start) * double(framesTimed + 1) / (framesTimed + 2);
        first_ = std::exchange(samples_, {});
        firstDevice_ = std::exchange(device_, {});
    }

    void visit() {
        runner_->restart();
        if (!slow_) runner_->frame();
        runner_->finish();
        samples_.push_back(timed(result_.framesPerSample));
        if (ownTimes_) visitAgain();
    }

    void finish() {
        if (samples_.empty()) samples_ = first_, device_ = firstDevice_;  // there was no patience for more
        result_.frame = measure::spreadOf(samples_);
        result_.device = measure::spreadOf(device_);
        if (timedFrames_ > 0) result_.busStateBytes = double(busBytes_) / double(timedFrames_);
    }

    double seconds = 0;  // of a visit

  private:
    // Repeats the frames, each between two timestamps, which the wall time is spared.
    void visitAgain() {
        runner_->restart();
        if (!slow_) runner_->frame();
        runner_->finish();
        double sum = 0;
        for (int i = 0; i < result_.framesPerSample; ++i)
            sum += timer_.secondsOf([&] { runner_->frame(); });
        device_.push_back(sum / result_.framesPerSample);
    }
    // Seconds a frame.
    double timed(int frames) {
        const uint64_t before = context_.traffic().total(gpu::Traffic::Kind::state);
        const double out = measure::secondsOf([&] { runner_->run(frames); }) / frames;
        busBytes_ += context_.traffic().total(gpu::Traffic::Kind::state) - before;
        timedFrames_ += frames;
        return out;
    }

    BenchResult& result_;
    std::unique_ptr<BenchRunner> runner_;
    gpu::Context& context_;
    bool slow_ = false;
    int64_t timedFrames_ = 0;
    uint64_t busBytes_ = 0;
    bool ownTimes_;
    gpu::DeviceTimer timer_;
    std::vector<double> samples_, device_;     // s a frame
    std::vector<double> first_, firstDevice_;  // of the warm-up's visit
};

}  // namespace

bool fitsAtPace(double seconds, double expected, double elapsed, double most) {
    const double pace = expected > 0 ? std::max(1.0, elapsed / expected) : 1;
    return elapsed + pace * seconds <= most;
}

std::vector<BenchResult> measureGroup(const std::vector<BenchCase>& cases, const BenchMolecules& molecules,
                                      const BenchDevice& device, const measure::Schedule& schedule,
                                      const BenchProgress& progress) {
    const Molecule& molecule = molecules.named(cases.front().molecule);
    const BenchStart start(cases.front(), molecule, device.cores);
    std::vector<BenchResult> out;
    out.reserve(cases.size());
    for (const BenchCase& benchCase : cases)
        out.push_back({.benchCase = benchCase,
                       .leftOut = reasonToLeaveOut(benchCase, molecule, device),
                       .mayFail = device.goesOn});
    measureInTurn(out, schedule, progress, [&](BenchResult& result) {
        return std::make_unique<FrameEntrant>(result, molecule, start, device);
    });
    device.context->checkErrors("bench");
    return out;
}

}  // namespace shoal::bench
