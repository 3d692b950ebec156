// What each solver does with each hard case. In the order of solvers():
// euler, verlet, leapfrog, rk4, xpbd, bdf2-xpbd, bdf2-corotated.
// On the ping-pong path the explicit ones do the same, and the implicit ones are refused.
#include <map>
#include <stdexcept>

#include "hard/outcome.h"

namespace shoal::test {

namespace {

constexpr Verdict P = Verdict::passes, R = Verdict::refuses, F = Verdict::fails;

const std::map<std::string, std::vector<Verdict>>& table() {
    static const std::map<std::string, std::vector<Verdict>> rows{
        {"harmonic spring, kicked", {P, P, P, P, P, P, P}},
        {"harmonic spring", {P, P, P, P, P, F, F}},
        {"damped spring", {P, P, P, P, P, F, F}},
        {"discrete recurrence", {P, P, P, P, P, P, P}},
        {"free fall", {P, P, P, P, P, P, P}},
        {"single vertex, ballistic", {P, P, P, P, P, P, P}},
        {"terminal velocity, gamma h 0.001 to 1", {P, P, P, P, P, P, P}},
        {"terminal velocity, gamma h 10 to 1e5", {P, P, P, R, P, P, P}},
        {"ABC advection", {P, P, P, P, P, P, P}},
        {"Taylor-Green stream function", {P, P, P, P, P, P, P}},
        {"rigid spin, 4 rad/s for 20 s", {P, P, P, P, P, P, P}},
        {"rigid spin, 21 rad/s for 20 s", {P, P, P, P, P, P, P}},
        {"rest shape, moved rigidly", {P, P, P, P, P, P, P}},
        {"Galilean shift", {P, P, P, P, P, P, P}},
        {"rotated world", {P, P, P, P, P, P, P}},
        {"100 km from the origin", {P, P, P, P, P, P, P}},
        {"pinned vertices keep their bits", {P, P, P, P, P, P, P}},
        {"a million steps, undamped", {P, P, P, P, P, P, P}},
        {"w h 0.1 to 1", {P, P, P, P, P, P, P}},
        {"w h 10 to 1000", {R, R, R, R, P, P, P}},
        {"mass ratio 1e6, w h 0.2", {P, P, P, P, P, P, P}},
        {"mass ratio 1e6, w h 23", {R, R, R, R, P, P, P}},
        {"frame hitch", {P, P, P, P, P, P, P}},
        {"symmetric stretch", {P, P, P, P, P, P, P}},
    };
    return rows;
}

}  // namespace

const std::vector<Verdict>& expectedOf(const std::string& name) {
    const auto row = table().find(name);
    if (row == table().end()) throw std::out_of_range(concat("no row of expected.cpp is \"", name, "\""));
    return row->second;
}

std::vector<std::string> expectedNames() {
    std::vector<std::string> out;
    for (const auto& [name, verdicts] : table())
        out.push_back(name);
    return out;
}

}  // namespace shoal::test
