// A day and more after the start everything is as much in phase as at it: fields and muscles against the
// recurrence in double precision, and a school against itself.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

namespace shoal {

using test::at;

namespace {

constexpr double late = 1e5 + 0.3;  // s

GridField film(std::vector<double> times) {
    GridField out;
    out.resolution = {2, 2, 2};
    out.low = {-3, 0, -2};
    out.high = {3, 5, 4};
    out.times = std::move(times);
    out.repeats = true;
    for (size_t i = 0; i < out.cells() * out.times.size(); ++i)
        out.values.emplace_back(0.5f * float(i % 7) - 1.5f, 0.3f * float(i % 11) - 1.5f,
                                0.4f * float(i % 13) - 2.4f);
    return out;
}

std::vector<Field> movingFields() {
    WavesField sea;
    sea.origin = {0.5, 3, 0};
    sea.depth = 3;
    sea.trains = {{{1, 0, 0.4}, 0.4, 7, 0.3}, {{-0.2, 0, 1}, 0.2, 3, 1}};
    std::vector<Field> out;
    GustField gust{{1, 0.2, 0.3}, 3, 0.6, 8, 6, 5.3, 7};
    CurlNoiseField eddies{1, 2, 1.7, 3, 5};
    gust.noise = eddies.noise = NoiseForm::computed;
    out.push_back(test::field(gust));
    out.push_back(test::field(eddies));
    for (const FieldShape& shape : std::vector<FieldShape>{
             OscillatingField{{1, -2, 0.5}, 1.1, 0.4}, GustField{{1, 0.2, 0.3}, 3, 0.6, 8, 6, 5.3, 7},
             CurlNoiseField{1, 2, 1.7, 3, 5}, film({0.1, 0.2, 0.3}), film({-0.1, 0, 0.17, 0.25}), sea})
        out.push_back(test::field(shape));
    return out;
}

void setTime(Simulation& simulation, double time) {
    SavedState state = simulation.save();
    state.time = time;
    simulation.load(state);
}

// How far the scene's molecules are from the reference's after 15 frames that begin late.
double errorLate(const Scene& scene, const CompileOptions& compiled, const SimulationOptions& options) {
    Simulation simulation(testContext(), compile(scene, compiled), options);
    setTime(simulation, late);
    const int frames = 15, count = int(scene.groups[0].place.items.size());
    std::vector<reference::State> expected;
    for (int m = 0; m < count; ++m) {
        expected.push_back(test::stateOf(simulation.snapshot(0), m));
        reference::frame(test::problemOf(scene, m), expected.back(), *scene.solver.kind,
                         frames / scene.frameRate, frames * scene.solver.substeps);
    }
    test::run(simulation, frames);
    double worst = 0;
    for (int m = 0; m < count; ++m)
        worst = std::max(worst, reference::relativeError(test::stateOf(simulation.snapshot(0), m),
                                                         expected[size_t(m)], 1));
    return worst;
}

struct Way {
    const char* name;
    SimulationOptions options;
    bool live = false;
};

std::vector<Way> ways() {
    std::vector<Way> out = {{"ping-pong", {.drawn = false, .path = Path::pingPong}},
                            {"fragments", {.drawn = false, .path = Path::fragments}},
                            {"live springs in fragments", {.drawn = false, .path = Path::fragments}, true}};
    if (!test::canFuse()) return out;
    out.push_back({"fused", {.drawn = false, .path = Path::fused}});
    out.push_back({"a lane a vertex", {.drawn = false, .path = Path::fused, .lanes = Lanes::vertex}});
    out.push_back({"live springs", {.drawn = false, .path = Path::fused}, true});
    return out;
}

}  // namespace

TEST_CASE("fields that move are in phase after a day", "[numerics][fields][late]") {
    const std::vector<Field> fields = movingFields();
    for (const Way& way : ways()) {
        if (way.live) continue;
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog,
                                    {at({1, 2, 1}), at({-0.6, 1, 0.4}), at({0.1, 2.6, -0.8})});
        scene.groups[0].drag = {9, 9};
        test::setSteps(scene, 1 / 60.0, 4);
        scene.fields = fields;
        INFO(way.name);
        CHECK(errorLate(scene, {}, way.options) < 1e-5);
    }
}

TEST_CASE("muscles of any frequencies are in phase after a day", "[numerics][late]") {
    Molecule leaf = test::leaf(200, 1);
    for (size_t i = 0; i < leaf.springs.size(); ++i)
        leaf.springs[i].actuation = Actuation{0.1, 0.7 + 0.31 * double(i), 0.5 * double(i)};
    for (const Way& way : ways()) {
        for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::bdf2Xpbd}) {
            if (shoal::solver(solver).implicit && !test::inOneLane(way.options)) continue;
            Scene scene = test::sceneOf(leaf, solver, {at({1, 2, 1}, test::turned(), 0.75), at({0, 1, 0})});
            scene.groups[0].phaseSpread = 2;
            test::setSteps(scene, 1 / 60.0, 4);
            INFO(way.name << ", " << name(solver));
            CHECK(errorLate(scene, {.liveSprings = way.live}, way.options) < 1e-5);
        }
    }
}

TEST_CASE("a school swims after a day as at the start", "[school][late]") {
    if (!test::canFuse()) return;
    Scene scene = test::swarm(test::shippedMolecule("fry"), 20, SolverKind::leapfrog, {0, 2, 0});
    scene.solver.substeps = 5;
    scene.groups[0].drag = {40, 1};
    scene.groups[0].school = School{};
    const SimulationOptions options = {.drawn = false, .path = Path::fused};
    Simulation early(testContext(), compile(scene), options);
    Simulation now(testContext(), compile(scene), options);
    setTime(now, 100 * 512 * std::numbers::pi);  // whole periods of what wanders
    test::run(early, 20);
    test::run(now, 20);
    const Snapshot a = early.snapshot(0), b = now.snapshot(0);
    double worst = 0;
    for (size_t i = 0; i < a.positions.size(); ++i)
        worst = std::max(worst, glm::length(a.positions[i] - b.positions[i]));
    CHECK(worst < 1e-5);
}

}  // namespace shoal
