#include "compile/clocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "molecule/molecule.h"

namespace shoal {

namespace {

constexpr double turn = 2 * std::numbers::pi;

glm::vec4 cellsAt(double place) {
    const double whole = std::floor(place);
    // beyond 2^32 cells the lattice repeats, as its hash does
    const auto cells = uint32_t(int64_t(std::fmod(whole, 4294967296.0)));
    return glm::vec4(float(place - whole), float(cells & 0xffff), float(cells >> 16), 0);
}

glm::vec2 frameAt(const FieldClock& clock, double time) {
    if (clock.period > 0) time -= std::floor((time - clock.times.front()) / clock.period) * clock.period;
    const auto next = std::upper_bound(clock.times.begin(), clock.times.end(), time);
    const auto last = next == clock.times.begin() ? next : next - 1;
    return glm::vec2(float(last - clock.times.begin()), float(time - *last));
}

}  // namespace

void setClocks(std::vector<glm::vec4>& parameters, const std::vector<ClockSlot>& clocks, double time) {
    for (const ClockSlot& clock : clocks) {
        glm::vec4& out = parameters[clock.slot];
        switch (clock.kind) {
        case FieldClock::Kind::angle:
            out.x = float(std::remainder(clock.start + clock.rate * time, turn));
            break;
        case FieldClock::Kind::cells:
            out = cellsAt(clock.start + clock.rate * time);
            break;
        case FieldClock::Kind::frames:
            const glm::vec2 frame = frameAt(clock, time);
            out.x = frame.x;
            out.y = frame.y;
            break;
        }
    }
}

std::vector<double> muscleFrequencies(const Molecule& molecule) {
    std::vector<double> out;
    for (const Spring& spring : molecule.springs)
        if (spring.actuation && muscleNumber(out, spring) == out.size())
            out.push_back(spring.actuation->frequency);
    return out;
}

size_t muscleNumber(const std::vector<double>& frequencies, const Spring& spring) {
    if (!spring.actuation) return 0;
    return size_t(std::find(frequencies.begin(), frequencies.end(), spring.actuation->frequency) -
                  frequencies.begin());
}

double commonPeriod(const std::vector<double>& frequencies) {
    double slowest = 0;
    for (const double frequency : frequencies)
        if (frequency > 0 && (slowest == 0 || frequency < slowest)) slowest = frequency;
    if (slowest == 0) return 0;
    double best = 1 / slowest, least = 1;  // the largest share of a wave that is off
    for (int n = 1; least > 1e-6 && (n == 1 || n / slowest <= 256); ++n) {
        double off = 0;
        for (const double frequency : frequencies)
            off = std::max(off, std::abs(std::remainder(frequency * n / slowest, 1.0)));
        if (off < least) best = n / slowest;
        least = std::min(least, off);
    }
    return best;
}

std::vector<glm::vec4> muscleAngles(const std::vector<double>& frequencies, double time) {
    std::vector<glm::vec4> out(std::max<size_t>(1, (frequencies.size() + 3) / 4), glm::vec4(0));
    for (size_t i = 0; i < frequencies.size(); ++i)
        out[i / 4][glm::length_t(i % 4)] = float(turn * std::remainder(frequencies[i] * time, 1.0));
    return out;
}

}  // namespace shoal
