#include "measure/timing.h"

#include <sched.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "core/error.h"

namespace shoal::measure {

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

double steadySeconds() {
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

TimeLimit::TimeLimit(std::optional<double> seconds, std::function<double()> clock)
    : seconds_(seconds), clock_(std::move(clock)), start_(clock_()) {}

double TimeLimit::left(double share) const {
    if (!seconds_) return std::numeric_limits<double>::infinity();
    return std::max(0.0, share * *seconds_ - (clock_() - start_));
}

TimeLimit TimeLimit::part(double share) const {
    TimeLimit out = *this;
    if (out.seconds_) *out.seconds_ *= share;
    return out;
}

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const size_t n = values.size(), middle = n / 2;
    const double median = n % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
    return {values.front(), median, int(n)};
}

bool losesAgain(double& challenger, double& best, const std::function<double()>& timeChallenger,
                const std::function<double()>& timeBest) {
    for (int round = 0; round < 3 && challenger >= best; ++round) {
        best = std::min(best, timeBest());
        const double again = timeChallenger();
        challenger = std::min(challenger, again);
        if (again > 3 * best && challenger > 3 * best) break;
    }
    return challenger >= best;
}

bool VisitPlan::visits(size_t i, int round) const {
    const int64_t n = samples[i];
    return (round + 1) * n / rounds > round * n / rounds;
}

VisitPlan planVisits(const std::vector<double>& cost, const Schedule& schedule) {
    VisitPlan out;
    const double share = schedule.seconds / double(std::max<size_t>(1, cost.size()));
    for (const double seconds : cost) {
        const double fit = std::min(double(schedule.mostSamples), share / std::max(seconds, 1e-9));
        const double least =
            std::min(double(schedule.leastSamples), schedule.patience / std::max(seconds, 1e-9));
        out.samples.push_back(int(std::max(least, fit)));
        out.rounds = std::max(out.rounds, out.samples.back());
        out.seconds += seconds * out.samples.back();
    }
    return out;
}

int pinRasteriserThreads() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    int pinned = 0;
    std::error_code none;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", none)) {
        std::ifstream file(task.path() / "comm");
        std::string name;
        std::getline(file, name);
        if (name.rfind("llvmpipe", 0) != 0) continue;
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET(unsigned(pinned++) % cores, &set);
        sched_setaffinity(std::stoi(task.path().filename().string()), sizeof set, &set);
    }
    return pinned;
}

}  // namespace shoal::measure
