#include "measure/method_runner.h"

#include <algorithm>
#include <numeric>

namespace shoal::measure {

namespace {

constexpr double sampleSeconds = 0.002;  // shorter samples are mostly noise
constexpr int leastSamples = 3, mostSamples = 15;
constexpr double usualSeconds = 30;  // of all samples, where nothing bounds them

int framesOfSample(const Contender& contender) {
    if (contender.secondsOfFrame > slowFrameSeconds) return 1;
    return std::clamp(int(sampleSeconds / std::max(contender.secondsOfFrame, 1e-7)), 2, 32);
}

double sample(const Contender& contender) {
    MethodRunner& runner = *contender.runner;
    runner.set(contender.step);
    runner.warmUp();
    const int frames = framesOfSample(contender);
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < frames; ++i)
        runner.frame();
    runner.finish();
    return secondsSince(start) / frames;
}

}  // namespace

double secondsOfVisit(const Contender& contender) {
    return contender.secondsOfStep + contender.secondsOfFrame * (framesOfSample(contender) + 1) + 1e-3;
}

double leastSeconds(const std::vector<Contender>& contenders) {
    double out = 0;
    for (const Contender& contender : contenders)
        out += leastSamples * secondsOfVisit(contender);
    return std::max(out, std::min(usualSeconds, out / leastSamples * mostSamples));
}

std::vector<bool> thoseThatFit(const std::vector<double>& cost, std::optional<double> seconds) {
    std::vector<bool> out(cost.size(), true);
    if (!seconds) return out;
    std::vector<size_t> order(cost.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return cost[a] < cost[b]; });
    double sum = 0;
    for (const size_t i : order)
        out[i] = (sum += cost[i]) <= *seconds || i == order.front();
    return out;
}

void visitInTurn(const std::vector<double>& cost, std::optional<double> seconds,
                 const std::function<double()>& clock, const std::function<void(size_t)>& visit) {
    Schedule schedule;
    schedule.seconds = seconds.value_or(usualSeconds);
    schedule.leastSamples = seconds ? 1 : leastSamples;
    schedule.mostSamples = mostSamples;
    const double start = clock();
    std::vector<double> dearest = cost;
    bool first = true;
    const auto visitInTime = [&](size_t i) {
        const double before = clock();
        if (seconds && !first && before - start + dearest[i] > *seconds) return;
        first = false;
        visit(i);
        dearest[i] = std::max(dearest[i], clock() - before);
    };
    // all once before any twice
    VisitPlan plan = planVisits(cost, schedule);
    for (size_t i = 0; i < cost.size(); ++i) {
        visitInTime(i);
        --plan.samples[i];
    }
    takeTurns(plan, visitInTime);
}

std::vector<Spread> timeInTurn(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               const std::function<void(double)>& tell) {
    std::vector<double> all, cost;
    for (const Contender& contender : contenders)
        all.push_back(secondsOfVisit(contender));
    const std::vector<bool> fits = thoseThatFit(all, seconds);
    std::vector<size_t> places;
    for (size_t i = 0; i < contenders.size(); ++i)
        if (fits[i]) places.push_back(i);
    // the cheap ones first: what a busy machine has no time for is the dearest
    std::stable_sort(places.begin(), places.end(), [&](size_t a, size_t b) { return all[a] < all[b]; });
    for (const size_t i : places)
        cost.push_back(all[i]);
    std::vector<std::vector<double>> samples(contenders.size());
    double done = 0;
    visitInTurn(cost, seconds, steadySeconds, [&](size_t i) {
        samples[places[i]].push_back(sample(contenders[places[i]]));
        tell(done += cost[i]);
    });
    std::vector<Spread> out(samples.size());
    std::transform(samples.begin(), samples.end(), out.begin(), spreadOf);
    return out;
}

}  // namespace shoal::measure
