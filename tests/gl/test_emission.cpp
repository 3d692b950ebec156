// The newborns of emitters are distributed as they say: Kolmogorov and Smirnov's test of each quantity
// against its distribution. One test rejects a right distribution with a probability of at most 1e-6 over the
// seeds (Massart's bound), all of this file together with less than 1e-4; the seeds are fixed.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "compile/birth_schedule.h"
#include "geometry/mesh.h"
#include "gl/births.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr int number = 20000;
constexpr double pi = std::numbers::pi;

// Emits `number` newborns in one burst, and returns them at the end of their frame of birth.
std::vector<Living> newborns(Emitter emitter, const Scene* with = nullptr, glm::dvec2 life = {1, 1}) {
    emitter.bursts = {{0, number, 0}};
    Scene scene = emitting(emitter, number, life);
    scene.seed = 20261;
    if (with) scene.models = with->models;
    Simulation simulation = simulationOf(scene);
    simulation.frame();
    std::vector<Living> out = livingOf(simulation);
    REQUIRE(out.size() == number);
    return out;
}

// The largest distance of the sample's distribution from uniform in [0, 1].
void checkUniform(std::vector<double> values, const std::string& what) {
    std::sort(values.begin(), values.end());
    double worst = 0;
    const double n = double(values.size());
    for (size_t i = 0; i < values.size(); ++i)
        worst = std::max({worst, double(i + 1) / n - values[i], values[i] - double(i) / n});
    INFO(what << ": distance " << worst);
    CHECK(worst < std::sqrt(std::log(2 / 1e-6) / (2 * n)));
    CHECK(worst > 0.1 / std::sqrt(n));  // more even than chance: no random numbers
}

void checkUniform(const std::vector<Living>& living, const std::string& what,
                  const std::function<double(const Living&)>& quantity) {
    std::vector<double> values;
    for (const Living& one : living)
        values.push_back(quantity(one));
    checkUniform(std::move(values), what);
}

double turnOf(double x, double y) {
    return std::atan2(y, x) / (2 * pi) + 0.5;
}

}  // namespace

TEST_CASE("places of emitters are uniform in their shapes", "[emission]") {
    if (!canSpawn()) return;
    Emitter emitter;
    SECTION("line") {
        emitter.from = Emitter::From::line;
        emitter.lineFrom = {1, 2, 3};
        emitter.lineTo = {3, 6, -1};
        const std::vector<Living> born = newborns(emitter);
        checkUniform(born, "along", [](const Living& one) { return (one.position.x - 1) / 2; });
        for (const Living& one : born)
            CHECK(glm::length(one.position -
                              glm::mix(emitter.lineFrom, emitter.lineTo, (one.position.x - 1) / 2)) < 1e-5);
    }
    SECTION("disc") {
        emitter.from = Emitter::From::disc;
        emitter.position = {5, 5, 5};
        emitter.radius = 2;
        emitter.hollow = 0.5;
        emitter.direction = {0, 0, 1};
        const std::vector<Living> born = newborns(emitter);
        const auto arm = [&](const Living& one) { return one.position - emitter.position; };
        checkUniform(born, "area", [&](const Living& one) { return (glm::dot(arm(one), arm(one)) - 1) / 3; });
        checkUniform(born, "turn", [&](const Living& one) { return turnOf(arm(one).x, arm(one).y); });
        for (const Living& one : born)
            CHECK(std::abs(arm(one).z) < 1e-5);
    }
    SECTION("sphere") {
        emitter.from = Emitter::From::sphere;
        emitter.radius = 3;
        emitter.hollow = 0.2;
        const std::vector<Living> born = newborns(emitter);
        checkUniform(born, "volume", [](const Living& one) {
            const double r = glm::length(one.position) / 3;
            return (r * r * r - 0.008) / 0.992;
        });
        checkUniform(born, "height", [](const Living& one) {
            return 0.5 + 0.5 * one.position.y / glm::length(one.position);
        });
        checkUniform(born, "turn", [](const Living& one) { return turnOf(one.position.x, one.position.z); });
    }
    SECTION("box") {
        emitter.from = Emitter::From::box;
        emitter.box = {{-1, 0, 2}, {1, 5, 2.5}};
        const std::vector<Living> born = newborns(emitter);
        for (int c = 0; c < 3; ++c)
            checkUniform(born, concat("axis ", c), [&](const Living& one) {
                return (one.position[c] - emitter.box.low[c]) / (emitter.box.high[c] - emitter.box.low[c]);
            });
    }
    SECTION("surface") {
        Scene scene;
        Model model;
        model.name = "two";
        // a unit square in y = 0, and a triangle of a third of its area above
        model.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1},      {0, 0, 1},
                                {0, 1, 0}, {1, 1, 0}, {0, 1, 2.0 / 3}};
        model.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}};
        completeMesh(model.mesh);
        scene.models.push_back(model);
        emitter.from = Emitter::From::surface;
        emitter.model = 0;
        emitter.along = Emitter::Along::outward;
        emitter.speed = {1, 1};
        std::vector<Living> born = newborns(emitter, &scene), below, above;
        for (Living& one : born) {
            one.position -= one.velocity * one.age;
            CHECK(glm::length(one.velocity - glm::dvec3(0, 1, 0)) < 1e-5);
            (one.position.y < 0.5 ? below : above).push_back(one);
        }
        // 3 to 1, within 5 standard deviations: wrong once in 1.7e6
        CHECK(std::abs(double(below.size()) - 0.75 * number) < 5 * std::sqrt(number * 0.75 * 0.25));
        checkUniform(below, "x", [](const Living& one) { return one.position.x; });
        checkUniform(below, "z", [](const Living& one) { return one.position.z; });
        // a triangle's share of its area below x
        checkUniform(above, "x above",
                     [](const Living& one) { return 1 - (1 - one.position.x) * (1 - one.position.x); });
    }
}

TEST_CASE("directions, speeds and spans are as an emitter says", "[emission]") {
    if (!canSpawn()) return;
    Emitter emitter;
    emitter.speed = {2, 5};
    emitter.direction = glm::normalize(glm::dvec3(1, 2, -2));
    for (const double spread : {0.01, 0.7, 2.5, pi}) {
        emitter.spread = spread;
        const std::vector<Living> born = newborns(emitter, nullptr, {3, 8});
        const auto along = [&](const Living& one) {
            return glm::dot(glm::normalize(one.velocity), emitter.direction);
        };
        const glm::dvec3 a = glm::normalize(glm::cross(emitter.direction, glm::dvec3(0, 1, 0))),
                         b = glm::cross(emitter.direction, a);
        if (spread > 0.1)  // float rounds 1 - cos of narrow cones
            checkUniform(born, concat("cone ", spread),
                         [&](const Living& one) { return (1 - along(one)) / (1 - std::cos(spread)); });
        checkUniform(born, concat("turn in cone ", spread), [&](const Living& one) {
            return turnOf(glm::dot(one.velocity, a), glm::dot(one.velocity, b));
        });
        checkUniform(born, "speed", [](const Living& one) { return (glm::length(one.velocity) - 2) / 3; });
        checkUniform(born, "span", [](const Living& one) { return (one.span - 3) / 5; });
        for (const Living& one : born)
            CHECK(along(one) >= std::cos(spread) - 1e-6);
    }
}

TEST_CASE("outward of a point is any direction", "[emission]") {
    if (!canSpawn()) return;
    Emitter emitter;
    emitter.along = Emitter::Along::outward;
    emitter.speed = {1, 1};
    const std::vector<Living> born = newborns(emitter);
    checkUniform(born, "height", [](const Living& one) { return 0.5 + 0.5 * one.velocity.y; });
    checkUniform(born, "turn", [](const Living& one) { return turnOf(one.velocity.x, one.velocity.z); });
}

TEST_CASE("random births come at any moment of a frame, and evenly in the long run", "[emission]") {
    if (!canSpawn()) return;
    Emitter emitter = steady(60.0 * number);
    emitter.random = true;
    Simulation simulation = simulationOf(emitting(emitter, 2 * number));
    simulation.frame();
    checkUniform(livingOf(simulation), "moment", [](const Living& one) { return one.age * 60; });
}

TEST_CASE("two emitters, two groups and two seeds have nothing in common", "[emission]") {
    if (!canSpawn()) return;
    Emitter emitter;
    emitter.from = Emitter::From::box;
    emitter.box = {{0, 0, 0}, {1, 1, 1}};
    emitter.bursts = {{0, number / 2, 0}};
    Scene scene = emitting(emitter, number);
    scene.groups[0].life->emitters.push_back(emitter);
    Simulation simulation = simulationOf(scene);
    simulation.frame();
    const std::vector<Living> born = livingOf(simulation);
    REQUIRE(born.size() == number);
    // the difference of two independent uniforms, wrapped, is uniform
    std::vector<double> differences;
    for (size_t i = 0; i < number / 2; ++i)
        differences.push_back(std::fmod(born[i].position.x - born[i + number / 2].position.x + 1, 1.0));
    checkUniform(differences, "of two emitters");
    scene.seed = 2;
    Simulation other = simulationOf(scene);
    other.frame();
    CHECK(other.hash() != simulation.hash());
}
