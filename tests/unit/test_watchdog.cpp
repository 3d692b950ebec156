// States that count as having run away, in the shaders and on the CPU.
#include <cmath>
#include <limits>

#include "simulate/simulation.h"
#include "simulate/watchdog.h"
#include "support/catch.h"
#include "support/shader_physics.h"

using namespace shoal;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

// One group of `molecules` pairs, at rest.
SavedState pairs(size_t molecules) {
    GroupState state;
    state.positions.resize(2 * molecules);
    state.velocities.resize(2 * molecules);
    state.anchors.resize(molecules);
    state.released.resize(molecules);
    SavedState out;
    out.groups = {state, state};
    return out;
}

}  // namespace

TEST_CASE("the shaders' word for a state that ran away", "[watchdog]") {
    using namespace shoal::shader;
    const auto place = squareBits({1, 2, 3});
    const auto fast = [&](const glm::vec3& v) { return isRunaway(squareBits(v), place); };
    CHECK(fastestDefine() == "FASTEST_SQUARED 1e+08");
    CHECK_FALSE(fast({0, 0, 0}));
    CHECK_FALSE(fast({-9999, 0, 0}));
    CHECK(fast({10001, 0, 0}));
    CHECK(fast({-8000, -8000, 0}));
    CHECK(fast({0, 1e30f, 0}));  // whose square is infinite
    for (const float bad : {notANumber, -notANumber, infinite, -infinite}) {
        CHECK(fast({0, bad, 0}));
        CHECK(isRunaway(0u, squareBits({bad, 0, 0})));
    }
    CHECK_FALSE(isRunaway(0u, squareBits({1e9f, -1e9f, 0})));
}

TEST_CASE("an alarm names the first that is not finite, else the fastest", "[watchdog]") {
    SavedState state = pairs(5);
    state.time = 0.5;
    state.frames = 30;
    CHECK_FALSE(runsAway(findAlarm(state)));
    state.groups[0].velocities[3] = {20, 0, 0};
    state.groups[1].velocities[8] = {0, 2e4f, 0};
    state.groups[1].velocities[9] = {0, -3e4f, 0};
    Alarm alarm = findAlarm(state);
    CHECK(runsAway(alarm));
    CHECK(alarm.finite);
    CHECK(alarm.group == 1);
    CHECK(alarm.molecule == 4);
    CHECK(alarm.vertex == 1);
    CHECK(alarm.speed == 3e4);
    CHECK(alarm.time == 0.5);
    CHECK(alarm.frame == 30);

    state.groups[1].positions[6].z = notANumber;
    alarm = findAlarm(state);
    CHECK_FALSE(alarm.finite);
    CHECK(alarm.molecule == 3);
    CHECK(alarm.vertex == 0);
    state.groups[0].velocities[3].x = infinite;
    CHECK(findAlarm(state).group == 0);
}
