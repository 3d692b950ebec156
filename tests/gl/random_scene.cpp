#include "gl/random_scene.h"

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "scene/json/scene_file.h"
#include "support/scratch.h"

namespace shoal::test {

static std::string randomText(uint64_t seed) {
    Random random(seed);
    const auto logarithmic = [&](double low, double high) {
        return std::exp(random.uniform(std::log(low), std::log(high)));
    };
    const auto one = [&](int among) { return int(random.uniform() * among); };
    const std::pair<std::string, double> kinds[] = {{"quad", 20}, {"cross", 10}, {"leaf", 0.39}, {"fry", 20}};
    const auto& [molecule, stiffness] = kinds[one(4)];
    std::string group = concat(
        R"("molecule": ")", molecule, R"(", "count": )", randomMolecules,
        R"(, "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}, )",
        R"("turn": "any", "scale": [0.7, 1.4]})", R"(, "stiffness": )", stiffness * logarithmic(0.1, 1000));
    const bool pinned = molecule == "leaf" && one(2) == 1;
    if (molecule == "leaf") group += concat(R"(, "held": )", pinned ? "true" : "false");
    if (one(4) > 0) {
        const double drag = logarithmic(0.1, 10);
        group += one(2) == 1 ? concat(R"(, "drag": {"normal": )", drag, R"(, "tangent": )", 0.1 * drag, "}")
                             : concat(R"(, "drag": )", drag);
    }
    const double speed = logarithmic(0.3, 3);
    const std::string winds[] = {
        "",
        concat(R"({"type": "shear", "gradient": [[0, )", speed, R"(, 0], [0, 0, )", speed, "], [0, 0, 0]]}"),
        concat(R"({"type": "vortex", "origin": [0.3, 0, 0.2], "axis": [0.2, 1, 0.1], "speed": )", speed,
               R"(, "radius": 0.5})"),
        concat(R"({"type": "gust", "direction": [1, 0, 0.3], "speed": )", speed, R"(, "length": 2})"),
        concat(R"({"type": "curlNoise", "speed": )", speed, R"(, "length": 1, "period": 1})")};
    const std::string wind = winds[one(5)];
    if (!pinned && one(3) == 0) {
        const double z = random.uniform(-8, 8), y = random.uniform(-8, 8), x = random.uniform(-8, 8);
        group += concat(R"(, "spin": [)", x, ", ", y, ", ", z, "]");
    }
    const std::string plane =
        one(4) == 0
            ? R"(, "colliders": [{"type": "plane", "point": [0, -0.5, 0], "restitution": 0.5, "friction": 0.3}])"
            : "";
    return concat(R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0], "fields": [)", wind, "]", plane,
                  R"(, "groups": [{)", group, "}]}");
}

Scene randomScene(uint64_t seed) {
    const Scratch scratch;
    scratch.write("random.scene.json", randomText(seed));
    return readScene(scratch.path("random.scene.json"));
}

}  // namespace shoal::test
