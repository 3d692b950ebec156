// The shipped hurricane: its crosses tell the wind's line and sense in a still picture.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl/births.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// A cross from above: the angle from its motion to its longest axis, anticlockwise from above, in
// [-90, 90) degrees, and how much longer than wide it is.
struct Seen {
    double distance, angle, elongation;
};

std::vector<Seen> seenFromAbove(const Snapshot& state) {
    std::vector<Seen> out;
    const size_t n = size_t(state.vertexCount);
    for (size_t m = 0; m < size_t(state.count); ++m) {
        if (!state.alive.empty() && !state.alive[m]) continue;
        glm::dvec2 middle(0), motion(0);
        const auto level = [](const glm::dvec3& v) { return glm::dvec2(v.x, -v.z); };
        for (size_t i = m * n; i < (m + 1) * n; ++i) {
            middle += level(state.positions[i]) / double(n);
            motion += level(state.velocities[i]) / double(n);
        }
        double xx = 0, yy = 0, xy = 0;
        for (size_t i = m * n; i < (m + 1) * n; ++i) {
            const glm::dvec2 d = level(state.positions[i]) - middle;
            xx += d.x * d.x, yy += d.y * d.y, xy += d.x * d.y;
        }
        const double half = std::hypot((xx - yy) / 2, xy), mean = (xx + yy) / 2;
        const double axis = 0.5 * std::atan2(2 * xy, xx - yy) - std::atan2(motion.y, motion.x);
        const double turns = axis / std::numbers::pi;
        out.push_back({glm::length(middle), 180 * (turns - std::floor(turns + 0.5)),
                       std::sqrt((mean + half) / std::max(mean - half, 1e-12))});
    }
    return out;
}

}  // namespace

TEST_CASE("the hurricane's crosses lie along the wind, their inner ends ahead", "[hurricane][fused]") {
    if (!canSpawn()) return;
    Scene scene = readScene(std::string(SHOAL_SOURCE_DIR) + "/models/hurricane/hurricane.scene.json");
    scene.groups[0].count = 600;
    Simulation simulation = simulationOf(scene);
    run(simulation, 240);
    double angle = 0, sense = 0;
    std::vector<double> elongation;
    for (const Seen& cross : seenFromAbove(simulation.snapshot(0))) {
        if (cross.distance < 10 || cross.distance > 30) continue;
        angle += std::abs(cross.angle);
        sense += cross.angle > 0 ? 1 : -1;
        elongation.push_back(cross.elongation);
    }
    const double count = double(elongation.size());
    REQUIRE(count > 80);
    std::sort(elongation.begin(), elongation.end());
    INFO("from the wind " << angle / count << " degrees, to one side " << sense / count << ", elongation "
                          << elongation[size_t(count) / 2]);
    // 45 degrees, either side and 1 for crosses that know nothing of the wind
    CHECK(angle / count < 20);
    CHECK(std::abs(sense / count) > 0.9);
    CHECK(elongation[size_t(count) / 2] > 2);
}
