#include "compile/birth_schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/random.h"

namespace shoal {

namespace {

// Exact, by transformed rejection from a mean of 10 ([Hoermann 1993], PTRS), below by Knuth's product.
double poisson(double mean, Random& random) {
    if (mean < 10) {
        const double least = std::exp(-mean);
        double product = random.uniform();
        int count = 0;
        for (; product > least; ++count)
            product *= random.uniform();
        return count;
    }
    const double b = 0.931 + 2.53 * std::sqrt(mean), a = -0.059 + 0.02483 * b;
    const double inverseAlpha = 1.1239 + 1.1328 / (b - 3.4), fast = 0.9277 - 3.6224 / (b - 2);
    for (;;) {
        const double u = random.uniform() - 0.5, v = random.uniform(), s = 0.5 - std::abs(u);
        const double k = std::floor((2 * a / s + b) * u + mean + 0.43);
        if (s >= 0.07 && v <= fast) return k;
        if (k < 0 || (s < 0.013 && v > s)) continue;
        if (std::log(v * inverseAlpha / (a / (s * s) + b)) <= k * std::log(mean) - mean - std::lgamma(k + 1))
            return k;
    }
}

class Adder {
  public:
    Adder(int emitter, BirthClock& clock, std::vector<BirthRun>& runs)
        : emitter_(emitter), clock_(&clock), runs_(&runs) {}

    void add(double count, int each, double first, double interval, bool random) {
        if (!(count >= 1)) return;
        BirthRun run{emitter_, clock_->born, int(std::min(count, double(mostInRun))), each, first,
                     interval, random};
        clock_->born += uint64_t(run.count);
        runs_->push_back(run);
    }

  private:
    int emitter_;
    BirthClock* clock_;
    std::vector<BirthRun>* runs_;
};

// Moments time + k every, k = 0, 1, ...: each falls into one frame, however the quotient is rounded.
void addBurst(const Burst& burst, double from, double to, Adder& adder) {
    if (burst.every <= 0) {
        if (burst.time >= from && burst.time < to) adder.add(burst.count, burst.count, burst.time, 0, false);
        return;
    }
    const auto moment = [&](double k) { return burst.time + k * burst.every; };
    const auto firstAt = [&](double time) {
        double k = std::max(0.0, std::ceil((time - burst.time) / burst.every));
        while (k > 0 && moment(k - 1) >= time)
            --k;
        while (moment(k) < time)
            ++k;
        return k;
    };
    const double first = firstAt(from), moments = firstAt(to) - first;
    adder.add(moments * burst.count, burst.count, moment(first), burst.every, false);
}

}  // namespace

void addRuns(const Emitter& emitter, int index, uint32_t seed, double from, double to, BirthClock& clock,
             std::vector<BirthRun>& runs) {
    if (emitter.from == Emitter::From::death) return;
    Adder adder(index, clock, runs);
    const double begin = std::max(from, emitter.begin), end = std::min(to, emitter.end);
    if (begin < end && emitter.rate > 0) {
        const double expected = emitter.rate * (end - begin);
        if (emitter.random) {
            Random random(std::bit_cast<uint64_t>(begin), hash(seed, uint32_t(index)));
            adder.add(poisson(std::min(expected, double(mostInRun)), random), 1, begin, end - begin, true);
        } else {
            const double count = std::floor(clock.due + expected);
            adder.add(count, 1, begin + (1 - clock.due) / emitter.rate, 1 / emitter.rate, false);
            clock.due = std::clamp(clock.due + expected - count, 0.0, std::nextafter(1.0, 0.0));
        }
    }
    for (const Burst& burst : emitter.bursts)
        addBurst(burst, from, to, adder);
}

int mostRuns(const Lifecycle& life) {
    size_t most = 0;
    for (const Emitter& emitter : life.emitters)
        most += 1 + emitter.bursts.size();
    return int(most);
}

}  // namespace shoal
