// A run that was saved to a file and goes on in another simulation is the run that never stopped, bit for
// bit.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "scene/field_kinds.h"
#include "simulate/checkpoint.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Simulation make(const Plan& plan, const SimulationOptions& options) {
    return Simulation(testContext(), plan, options);
}

// Leaves that hang, tear off and fly metres away, in gusts, onto the ground; beside them points.
Plan storm(SolverKind solver) {
    Molecule leaf = shippedMolecule("leaf");
    leaf.vertices[0].pinned = true;
    addMuscles(leaf, 0.1);
    Scene scene = swarm(leaf, 131, solver, {0, 2, 0});
    scene.gravity = {0, -9.81, 0};
    scene.fields = {test::field(GustField{.speed = 20})};
    scene.colliders = {everyCollider()[0], everyCollider()[1]};
    Group& group = scene.groups[0];
    group.drag = {6, 1};
    group.phaseSpread = 3;
    group.release = Release{0.5, 1.0, 0};
    Group points = swarm(test::point(0.1), 7, solver).groups[0];
    points.drag = {2, 2};
    scene.groups.push_back(points);
    setStableSubsteps(scene);
    return compile(scene);
}

void goOn(Simulation& simulation, const std::string& file) {
    const Checkpoint from = readCheckpoint(file, simulation.plan());
    simulation.load(from.state);
    simulation.parameters = from.parameters;
}

void saveTo(const std::string& file, const Simulation& simulation) {
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
}

// Implicit ones keep a molecule in one lane.
std::vector<SolverKind> solversOf(const SimulationOptions& options) {
    std::vector<SolverKind> out;
    for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog, SolverKind::bdf2Xpbd}) {
        if (inOneLane(options) || !shoal::solver(solver).implicit) out.push_back(solver);
    }
    return out;
}

struct Way {
    const char* name;
    SimulationOptions options;
};

std::vector<Way> ways() {
    std::vector<Way> out = {{"ping-pong", {.path = Path::pingPong}},
                            {"fragments", {.path = Path::fragments}}};
    if (!testContext().info().computeShaders) return out;
    out.push_back({"fused", {.path = Path::fused}});
    out.push_back({"in place", {.path = Path::fused, .inPlace = true}});
    out.push_back({"a lane a vertex", {.path = Path::fused, .lanes = Lanes::vertex}});
    return out;
}

}  // namespace

TEST_CASE("a run goes on from a file as if it had never stopped", "[checkpoint]") {
    const Scratch scratch;
    const std::string file = scratch.path("x.shoal");
    for (const Way& way : ways()) {
        for (const SolverKind solver : solversOf(way.options)) {
            INFO(way.name << ", " << name(solver));
            const Plan plan = storm(solver);
            Simulation whole = make(plan, way.options);
            whole.parameters.wind = 1.25;  // a slider
            run(whole, 30);
            saveTo(file, whole);
            const SavedState middle = whole.save();
            run(whole, 30);

            Simulation rest = make(plan, way.options);
            goOn(rest, file);
            CHECK(rest.frames() == 30);
            CHECK(rest.time() == middle.time);
            run(rest, 30);
            CHECK(rest.hash() == whole.hash());
            CHECK(rest.time() == whole.time());
            CHECK(rest.frames() == 60);

            // it was worth carrying
            const GroupState& state = middle.groups[0];
            const auto released = std::count(state.released.begin(), state.released.end(), 1);
            CHECK((released > 5 && released < 131));
            CHECK(state.anchors != plan.groups[0].start.anchors);
        }
    }
}

TEST_CASE("a run saved on one path goes on on the other from the same state", "[checkpoint]") {
    if (!canFuse()) return;
    const Scratch scratch;
    const std::string file = scratch.path("x.shoal"), back = scratch.path("y.shoal");
    const Plan plan = storm(SolverKind::leapfrog);
    Simulation fused = make(plan, {.path = Path::fused}), inPlace = make(plan, {.inPlace = true});
    run(fused, 20);
    saveTo(file, fused);
    for (const Path path : {Path::pingPong, Path::fragments}) {
        Simulation other = make(plan, {.path = path});
        goOn(other, file);
        CHECK(other.save().groups == fused.save().groups);
        saveTo(back, other);
        CHECK(readFile(back) == readFile(file));
    }
    goOn(inPlace, back);
    run(inPlace, 5);
    run(fused, 5);
    CHECK(inPlace.hash() == fused.hash());
}

TEST_CASE("what the watchdog saves can be gone on from", "[checkpoint][watchdog]") {
    if (!canFuse()) return;
    const Scratch scratch;
    const std::string file = scratch.path("x.shoal");
    const Plan plan = storm(SolverKind::leapfrog);
    Simulation simulation = make(plan, {.path = Path::fused});
    simulation.parameters.stiffness = 1e4;
    CHECK_THROWS_AS(run(simulation, 100), Runaway);
    const std::optional<SavedState> before = simulation.saveBefore();
    REQUIRE(before);
    writeCheckpoint(file, plan, {*before, simulation.parameters});
    Simulation again = make(plan, {.path = Path::fused});
    again.load(readCheckpoint(file, plan).state);
    again.parameters.substeps = 20 * plan.substeps;
    run(again, 5);
    CHECK_NOTHROW(again.check());
    again.load(*before);
    again.parameters = simulation.parameters;
    again.frame();
    CHECK_THROWS_AS(again.check(), Runaway);
}
