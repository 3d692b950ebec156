#include "measure/accuracy_times.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "measure/bench.h"

namespace shoal::measure {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double slowFrameSeconds = 0.1;  // above: single frames are timed
constexpr double sampleSeconds = 0.002;   // shorter samples are mostly noise
constexpr int leastSamples = 3, mostSamples = 15;
constexpr double usualSeconds = 30;  // of all samples, where nothing bounds them

int framesOfSample(const Contender& one) {
    if (one.secondsOfFrame > slowFrameSeconds) return 1;
    return std::clamp(int(sampleSeconds / std::max(one.secondsOfFrame, 1e-7)), 2, 32);
}

double sample(const Contender& one) {
    MethodRunner& runner = *one.runner;
    runner.set(one.step);
    runner.warmUp();
    const int frames = framesOfSample(one);
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < frames; ++i)
        runner.frame();
    runner.finish();
    return std::chrono::duration<double>(Clock::now() - start).count() / frames;
}

// The contenders that fit, cheapest first, as flags.
std::vector<bool> thoseThatFit(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               int samples) {
    std::vector<bool> out(contenders.size(), true);
    if (!seconds) return out;
    std::vector<size_t> order(contenders.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return contenders[a].secondsOfFrame < contenders[b].secondsOfFrame;
    });
    double sum = 0;
    for (const size_t i : order) {
        sum += samples * secondsOfVisit(contenders[i]);
        out[i] = sum <= *seconds;
    }
    return out;
}

}  // namespace

double secondsOfVisit(const Contender& one) {
    return one.secondsOfFrame * (framesOfSample(one) + 1) + 1e-3;
}

double leastSeconds(const std::vector<Contender>& contenders) {
    double out = 0;
    for (const Contender& one : contenders)
        out += leastSamples * secondsOfVisit(one);
    return std::max(out, std::min(usualSeconds, out / leastSamples * mostSamples));
}

std::vector<Spread> timeInTurn(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               const std::function<void(double)>& tell) {
    const int least = seconds ? 1 : leastSamples;
    const std::vector<bool> fits = thoseThatFit(contenders, seconds, least);
    std::vector<size_t> places;
    std::vector<double> cost;
    for (size_t i = 0; i < contenders.size(); ++i) {
        if (!fits[i]) continue;
        places.push_back(i);
        cost.push_back(secondsOfVisit(contenders[i]));
    }
    BenchSchedule schedule;
    schedule.seconds = seconds.value_or(usualSeconds);
    schedule.leastSamples = least;
    schedule.mostSamples = mostSamples;
    std::vector<std::vector<double>> samples(contenders.size());
    double done = 0;
    takeTurns(planVisits(cost, schedule), [&](size_t i) {
        samples[places[i]].push_back(sample(contenders[places[i]]));
        tell(done += cost[i]);
    });
    std::vector<Spread> out;
    for (const std::vector<double>& one : samples)
        out.push_back(spreadOf(one));
    return out;
}

}  // namespace shoal::measure
