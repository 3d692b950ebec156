// What a run tells of itself while it goes on, against the whole state and the reference of all molecules.
#include <algorithm>
#include <cmath>

#include "gl/marbles.h"
#include "gl/numerics.h"
#include "gl/random_scene.h"
#include "measure/diagnostics.h"
#include "measure/overlap.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using namespace measure;

namespace {

constexpr double unlimited = 1e6;  // s

// Nothing is left out for want of time.
DiagnosticsOptions withoutLimits(int molecules) {
    DiagnosticsOptions out;
    out.molecules = molecules;
    out.leastSeconds = unlimited;
    return out;
}

// Runs so many frames, followed, and takes the last reading.
Reading readingAfter(const Scene& scene, Simulation& simulation, int frames, int molecules) {
    Diagnostics diagnostics(scene, simulation, withoutLimits(molecules));
    diagnostics.follow();
    for (int i = 0; i < frames; ++i) {
        simulation.frame();
        diagnostics.follow();
    }
    diagnostics.finish(unlimited);
    return *diagnostics.reading();
}

Simulation simulationHere(const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.drawn = false, .path = testPath()});
}

// RMS over all molecules of the error after a second.
double trueError(const Scene& scene, Simulation& simulation) {
    const std::vector<Snapshot> starts = {simulation.snapshot(0)};
    run(simulation, int(std::lround(scene.frameRate)));
    ExactEnds exact(scene, simulation.plan(), starts, 1, 2, starts[0].count);
    const Settled settled = exact.solve(1e-5, 60);
    CHECK(settled <= Settled::roughly);
    return exact.errorOf({simulation.snapshot(0)}).total;
}

// Two quads in all that parameters have a factor for.
Scene blown() {
    Scene scene = sceneOf(shippedMolecule("quad"), SolverKind::rk4, {at({0, 1, 0}), at({1, 2, 0})});
    scene.gravity = {0, -9.81, 0};
    Field wind;
    wind.shape = FieldShape(ShearField{.gradient = glm::dmat3(0, 1, 0, 0, 0, 2, 0, 0, 0)});
    scene.fields = {wind};
    Force gale;
    gale.shape = ForceShape(WindForce{{2, 0, 0}});
    scene.forces = {gale};
    scene.groups[0].drag = {2, 2};
    setSteps(scene, 1.0 / 60, 8);
    return scene;
}

}  // namespace

TEST_CASE("the error estimated from a third of the molecules is that of all within a factor of 3",
          "[diagnostics][fused]") {
    for (const uint64_t seed : {5u, 6u, 8u, 9u, 12u, 14u}) {
        const Scene scene = randomScene(seed);
        Simulation simulation = simulationHere(scene);
        const Reading reading = readingAfter(scene, simulation, 60, randomMolecules / 3);
        simulation.restart();
        const double truth = trueError(scene, simulation);
        REQUIRE(reading[Diagnostic::error]);
        const double ratio = *reading[Diagnostic::error] / truth;
        CAPTURE(seed, truth, ratio, reading.judged, reading.unknown);
        CHECK(reading.judged == randomMolecules / 3);
        CHECK(reading.unknown == 0);
        CHECK(ratio < 3);
        CHECK(ratio > 1.0 / 3);
    }
}

TEST_CASE("the error is of the parameters that a run has", "[diagnostics]") {
    const Scene scene = blown();
    Simulation simulation = simulationHere(scene);
    Parameters& p = simulation.parameters;
    const auto error = [&] {
        simulation.restart();
        return readingAfter(scene, simulation, 60, 8)[Diagnostic::error].value();
    };
    CHECK(error() < 1e-4);
    p.gravity = {1, -5, 0};
    p.wind = 0.5;
    p.drag = 1.5;
    p.stiffness = 0.8;
    p.damping = 0.5;
    p.fields = {0.7};
    p.forces[0].factor = 0.3;
    CHECK(error() < 1e-4);
    p.forces[0].on = false;
    CHECK(error() < 1e-4);
}

TEST_CASE("a change of parameters or of the state begins another stretch", "[diagnostics]") {
    const Scene scene = blown();
    Simulation simulation = simulationHere(scene);
    Diagnostics diagnostics(scene, simulation, withoutLimits(8));
    diagnostics.follow();
    const auto go = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            simulation.frame();
            diagnostics.follow();
        }
    };
    go(30);
    simulation.parameters.wind = 3;  // the reference from frame 0 on would go another way
    go(50);
    diagnostics.finish(unlimited);
    REQUIRE(diagnostics.reading()->values[size_t(Diagnostic::error)]);
    CHECK(*(*diagnostics.reading())[Diagnostic::error] < 1e-4);
    CHECK(diagnostics.reading()->duration < 0.9);
    go(10);
    simulation.restart();
    go(10);
    diagnostics.finish(unlimited);
    CHECK(*(*diagnostics.reading())[Diagnostic::error] < 1e-4);
}

TEST_CASE("strains that a run tells are those of its state, and it leaves the same bits",
          "[diagnostics][fused]") {
    Scene scene = randomScene(5);
    for (Spring& spring : scene.groups[0].molecule.springs)
        spring.actuation = Actuation{.amplitude = 0.2, .frequency = 2, .phase = 0.3};
    scene.groups[0].phaseSpread = 1;
    Simulation plain = simulationHere(scene), told = simulationHere(scene);
    run(plain, 45);
    const Reading reading = readingAfter(scene, told, 45, randomMolecules);
    CHECK(plain.hash() == told.hash());
    const Snapshot state = plain.snapshot(0);
    const GroupConstants& constants = plain.plan().groups[0].constants;
    double largest = 0, square = 0;
    int count = 0;
    for (int m = 0; m < state.count; ++m)
        for (const Spring& spring : scene.groups[0].molecule.springs) {
            const size_t first = size_t(m) * size_t(state.vertexCount);
            const double turns = 2 * 3.14159265358979 * spring.actuation->frequency * state.time;
            const double rest = double(constants.scales[size_t(m)]) *
                                scene.groups[0].molecule.restLength(spring) *
                                (1 + 0.2 * std::sin(turns + 0.3 + double(constants.phases[size_t(m)])));
            const double strain = std::abs(glm::distance(state.positions[first + size_t(spring.a)],
                                                         state.positions[first + size_t(spring.b)]) /
                                               rest -
                                           1);
            largest = std::max(largest, strain);
            square += strain * strain;
            ++count;
        }
    CHECK(reading[Diagnostic::strain].value() == Approx(largest).epsilon(1e-6));
    CHECK(reading[Diagnostic::rmsStrain].value() == Approx(std::sqrt(square / count)).epsilon(1e-6));
}

TEST_CASE("overlaps that a run tells are those of all pairs of spheres", "[diagnostics][fused]") {
    Scene scene = strewn(60, glm::dvec3(0.5), 0.06, {0.7, 1.3});
    scene.groups[0].contact->triangles = true;
    Simulation simulation = simulationOn(pathHere(), compile(scene));
    Diagnostics diagnostics(scene, simulation, withoutLimits(8));
    simulation.frame();
    CHECK_FALSE(diagnostics.lacks(Diagnostic::overlap));
    CHECK(diagnostics.lacks(Diagnostic::error));
    diagnostics.follow();
    diagnostics.finish(0);
    const Reading reading = *diagnostics.reading();
    Plan plan = compile(scene);
    plan.groups[0].start = simulation.save().groups[0];
    const std::vector<reference::Sphere> spheres = spheresOf(plan);
    double largest = 0;
    for (const auto& [a, b] : simulation.contact()->found()) {
        const reference::Sphere &one = spheres[size_t(a)], &other = spheres[size_t(b)];
        largest =
            std::max(largest, (one.radius + other.radius - glm::distance(one.position, other.position)) /
                                  std::min(one.radius, other.radius));
    }
    REQUIRE(largest > 0.1);
    CHECK(reading[Diagnostic::overlap].value() == Approx(largest).epsilon(1e-6));
    CHECK(reading[Diagnostic::rmsOverlap].value() < largest);
    CHECK(reading[Diagnostic::contactsDropped].value() == double(simulation.contact()->dropped()));
}

TEST_CASE("molecules that lie together are read alike one by one", "[diagnostics]") {
    Scene scene = randomScene(6);
    scene.groups[0].count = 1100;  // more than a row of a texture
    Simulation simulation = simulationHere(scene);
    run(simulation, 3);
    const GroupState all = simulation.save().groups[0];
    const size_t vertices = simulation.plan().groups[0].pinned.size();
    for (const auto& [first, count] : {std::pair<size_t, size_t>{0, 5}, {13, 40}, {1000, 100}, {1099, 1}}) {
        const GroupState some = simulation.readMolecules(0, first, count);
        CAPTURE(first, count);
        REQUIRE(some.positions.size() == count * vertices);
        CHECK(std::equal(some.positions.begin(), some.positions.end(),
                         all.positions.begin() + ptrdiff_t(first * vertices)));
        CHECK(std::equal(some.velocities.begin(), some.velocities.end(),
                         all.velocities.begin() + ptrdiff_t(first * vertices)));
        CHECK(std::equal(some.anchors.begin(), some.anchors.end(), all.anchors.begin() + ptrdiff_t(first)));
        for (size_t m = 0; m < count; ++m)
            CHECK(some.looks[m].x == simulation.plan().groups[0].constants.scales[first + m]);
    }
}

}  // namespace shoal
