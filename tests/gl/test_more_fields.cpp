// Every kind of field on both paths, against the recurrence in double precision.
#include <cmath>
#include <numbers>

#include "gl/agreement.h"
#include "gl/numerics.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"

namespace shoal {

using test::at;

namespace {

GridField film(std::vector<double> times, bool repeats) {
    GridField out;
    out.resolution = {3, 4, 5};
    out.low = {-3, 0, -2};
    out.high = {3, 5, 4};
    out.times = std::move(times);
    out.repeats = repeats;
    for (size_t i = 0; i < 60 * out.times.size(); ++i)
        out.values.emplace_back(0.5f * float(i % 7) - 1.5f, 0.3f * float(i % 11) - 1.5f,
                                0.4f * float(i % 13) - 2.4f);
    return out;
}

// Some molecules lie between its last cells and, around its border, the first.
GridField wrapped() {
    GridField out = film({0, 0.3}, false);
    out.wrap = true;
    out.low = {-5, -2.5, -3};
    out.high = {1, 2.5, 1};
    return out;
}

WavesField sea(std::optional<double> depth) {
    WavesField out;
    out.origin = {0.5, 3, 0};
    out.depth = depth;
    out.trains = {{{1, 0, 0.4}, 0.4, 7, 0.3}, {{-0.2, 0, 1}, 0.2, 3, 1}, {{1, 0, -1}, 0.1, 1.7, 2}};
    return out;
}

}  // namespace

TEST_CASE("every kind of field moves molecules as the reference says", "[numerics][fields]") {
    std::vector<FieldShape> shapes = {film({0, 0.25, 0.5, 0.75}, false),
                                      film({0.1, 0.2, 0.3}, true),
                                      film({0.05, 0.2, 0.6}, false),
                                      film({-0.1, 0, 0.17, 0.25}, true),
                                      wrapped(),
                                      sea({}),
                                      sea(3.0),
                                      HurricaneField{{0.5, -1, 0.2}, 6, 1.5, 1.4, 0.4, 9, 0.2},
                                      HurricaneField{{0, -1, 0}, -6, 1.5, 2.2, 0.4, 9}};
    for (test::KindOfField& kind : test::kindsOfField())
        shapes.push_back(std::move(kind.shape));
    const Molecule leaf = test::leaf(200, 1);
    // The weights of a GPU's filter, for tables of noise, have 8 bits: 3e-5 was seen.
    const double most = testContext().info().software ? 1e-5 : 1e-4;
    std::vector<Path> paths = {Path::pingPong};
    if (test::canFuse()) paths.push_back(Path::fused);
    for (const Path path : paths)
        for (size_t i = 0; i < shapes.size(); ++i) {
            Scene scene = test::sceneOf(
                leaf, SolverKind::leapfrog,
                {at({1, 2, 1}, test::turned(), 0.75), at({-0.6, 1, 0.4}), at({0.1, 2.6, -0.8})});
            scene.groups[0].drag = {3, 1.5};
            scene.fields = {test::field(shapes[i])};
            test::setSteps(scene, 1 / 60.0, 4);
            Simulation simulation(testContext(), compile(scene), {.path = path});
            std::vector<reference::State> expected;
            for (int m = 0; m < 3; ++m) {
                expected.push_back(test::stateOf(simulation.snapshot(0), m));
                reference::frame(test::problemOf(scene, m), expected.back(), SolverKind::leapfrog, 0.5, 120);
            }
            test::run(simulation, 30);
            for (int m = 0; m < 3; ++m) {
                const reference::State state = test::stateOf(simulation.snapshot(0), m);
                const double error = reference::relativeError(state, expected[size_t(m)], 1);
                INFO(name(path) << ", field " << i << ", molecule " << m << ", off by " << error);
                CHECK(error < most);
            }
        }
}

// A point without springs, dragged by a uniform wind U sin(w t + a):
// v = p(t) + (v(0) - p(0)) e^(-g t), p = U g (g sin(w t + a) - w cos(w t + a)) / (g^2 + w^2).
TEST_CASE("every solver keeps its order in a wind that changes", "[numerics][fields]") {
    const double wave = 8 * std::numbers::pi, rate = 3, angle = 0.5, time = 0.5, peak = 2;
    const auto particular = [&](double t) {
        return peak * rate * (rate * std::sin(wave * t + angle) - wave * std::cos(wave * t + angle)) /
               (rate * rate + wave * wave);
    };
    const auto summed = [&](double t) {
        return -peak * rate * (rate / wave * std::cos(wave * t + angle) + std::sin(wave * t + angle)) /
               (rate * rate + wave * wave);
    };
    const double way = summed(time) - summed(0) - particular(0) * (1 - std::exp(-rate * time)) / rate;
    for (const SolverKind kind : test::solversHere()) {
        double error[2];
        for (const int finer : {0, 1}) {
            Scene scene = test::sceneOf(test::point(1), kind);
            scene.gravity = {};
            scene.groups[0].drag = {rate, rate};
            scene.fields = {
                test::field(OscillatingField{{peak, 0, 0}, wave / (2 * std::numbers::pi), angle})};
            test::setSteps(scene, 1 / 60.0, 1 << finer);
            Simulation simulation = test::simulationOf(scene);
            test::run(simulation, 30);
            error[finer] = std::abs(simulation.snapshot(0).positions[0].x - way);
        }
        INFO(name(kind) << ": " << error[0] << " m, then " << error[1] << " m");
        CHECK((error[1] < 1e-6 || std::log2(error[0] / error[1]) > test::orderOf(kind) - 0.3));
    }
}

}  // namespace shoal
