// The watchdog notices in the next frame what is not finite or too fast, says who, and leaves healthy runs
// alone.
#include <algorithm>
#include <ctime>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gpu/gl.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace shoal::test;

namespace {

struct Way {
    const char* name;
    SimulationOptions options;
};

// Every way to run that the context has.
std::vector<Way> ways() {
    std::vector<Way> out;
    out.push_back({"ping-pong", {.path = Path::pingPong}});
    out.push_back({"fragments", {.path = Path::fragments}});
    if (testContext().info().computeShaders) {
        out.push_back({"fused", {.path = Path::fused, .lanes = Lanes::molecule}});
        out.push_back({"fused, a lane a vertex", {.path = Path::fused, .lanes = Lanes::vertex}});
        out.push_back({"fused, in place", {.path = Path::fused, .inPlace = true}});
        out.push_back({"as on a GPU", {.path = Path::fused, .lanes = Lanes::molecule, .asOnGpu = true}});
        out.push_back(
            {"a lane a vertex, as on a GPU", {.path = Path::fused, .lanes = Lanes::vertex, .asOnGpu = true}});
    }
    return out;
}

// Whether the state before the last frame is still there.
bool hasTwoSides(const SimulationOptions& options) {
    return options.path != Path::pingPong && !options.inPlace;
}

Simulation make(const Plan& plan, const SimulationOptions& options) {
    return Simulation(testContext(), plan, options);
}

// Two groups, of which the second is looked at; quads high in the air.
Plan manyQuads(int count, SolverKind solver = SolverKind::leapfrog) {
    Scene scene = swarm(shippedMolecule("quad"), count, solver, {0, 50, 0});
    scene.groups.push_back(scene.groups[0]);
    scene.groups[0].count = 3;
    scene.groups[0].name = "few";
    scene.groups[1].name = "many";
    scene.gravity = {0, -9.81, 0};
    setStableSubsteps(scene);
    return compile(scene);
}

std::optional<Alarm> alarmOf(Simulation& simulation, int frames = 1) {
    try {
        for (int i = 0; i < frames; ++i)
            simulation.frame();
        simulation.check();
    } catch (const Runaway& runaway) {
        return runaway.alarm();
    }
    return {};
}

}  // namespace

TEST_CASE("what is not finite is noticed in the next frame, at its vertex", "[watchdog]") {
    const Plan plan = manyQuads(5000);
    for (const Way& way : ways()) {
        Simulation simulation = make(plan, way.options);
        INFO(way.name);
        REQUIRE_FALSE(alarmOf(simulation, 2));
        const SavedState good = simulation.save();
        for (const float bad :
             {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
            for (const bool position : {false, true}) {
                SavedState spoiled = good;
                GroupState& group = spoiled.groups[1];
                (position ? group.positions : group.velocities)[4 * 4321 + 2].y = bad;
                simulation.load(spoiled);
                const std::optional<Alarm> alarm = alarmOf(simulation);
                REQUIRE(alarm);
                CHECK(alarm->group == 1);
                CHECK(alarm->molecule == 4321);
                CHECK_FALSE(alarm->finite);
                // where only the state after the frame is left, springs have carried it to every vertex
                const bool twoSides = hasTwoSides(way.options);
                CHECK(alarm->vertex == (twoSides ? 2 : alarm->vertex));
                CHECK(alarm->frame == (twoSides ? 2 : 3));
                CHECK(simulation.frames() == 3);
                CHECK_THROWS_AS(simulation.frame(), Runaway);  // and it stays so
                CHECK(simulation.frames() == 3);
            }
        }
        simulation.load(good);
        CHECK_FALSE(alarmOf(simulation, 2));
    }
}

TEST_CASE("a place that is not finite is noticed where no spring makes a speed of it", "[watchdog]") {
    Scene scene = swarm(test::point(1), 200, SolverKind::euler);
    const Plan plan = compile(scene);
    for (const Way& way : ways()) {
        INFO(way.name);
        Simulation simulation = make(plan, way.options);
        SavedState state = simulation.save();
        state.groups[0].positions[150].z = std::numeric_limits<float>::quiet_NaN();
        simulation.load(state);
        const std::optional<Alarm> alarm = alarmOf(simulation);
        REQUIRE(alarm);
        CHECK(alarm->molecule == 150);
        CHECK_FALSE(alarm->finite);
    }
}

TEST_CASE("a vertex above the limit is noticed, one below is not", "[watchdog]") {
    const Plan plan = manyQuads(5000);
    for (const Way& way : ways()) {
        INFO(way.name);
        Simulation simulation = make(plan, way.options);
        const SavedState good = simulation.save();
        // a whole molecule, which springs do not slow down
        const auto withSpeed = [&](float speed) {
            SavedState out = good;
            for (size_t v = 0; v < 4; ++v)
                out.groups[1].velocities[4 * 4999 + v] = {-speed, 0, 0};
            out.groups[1].velocities[4 * 4999 + 3].x *= 1.0001f;
            return out;
        };
        simulation.load(withSpeed(9990));
        CHECK_FALSE(alarmOf(simulation));
        simulation.load(withSpeed(10010));
        const std::optional<Alarm> alarm = alarmOf(simulation);
        REQUIRE(alarm);
        CHECK(alarm->molecule == 4999);
        CHECK(alarm->finite);
        CHECK(alarm->speed > 1e4);
        CHECK(alarm->speed < 1.01e4);
    }
}

TEST_CASE("what runs away in a frame of several contact steps is noticed, and stays", "[watchdog]") {
    if (!canFuse()) return;
    Scene scene = swarm(shippedMolecule("quad"), 100, SolverKind::leapfrog, {0, 50, 0});
    scene.groups[0].contact.emplace().radius = 0.001;
    setStableSubsteps(scene);
    const Plan plan = compile(scene);
    REQUIRE(plan.contact.steps > 1);
    for (const bool asOnGpu : {false, true}) {
        CAPTURE(asOnGpu);
        Simulation simulation = make(plan, {.path = Path::fused, .asOnGpu = asOnGpu});
        REQUIRE_FALSE(alarmOf(simulation, 2));
        SavedState spoiled = simulation.save();
        for (size_t v = 0; v < 4; ++v)
            spoiled.groups[0].velocities[4 * 70 + v] = {0, 2e4f, 0};
        simulation.load(spoiled);
        simulation.frame();
        CHECK_THROWS_AS(simulation.frame(), Runaway);
        CHECK(simulation.frames() == 3);
        const std::optional<Alarm> alarm = alarmOf(simulation, 0);
        REQUIRE(alarm);
        CHECK(alarm->molecule == 70);
        CHECK(alarm->speed > 1e4);
    }
}

TEST_CASE("the message says who, when and what may help", "[watchdog]") {
    const Plan plan = manyQuads(100);
    Simulation simulation = make(plan, {.path = testPath()});
    run(simulation, 6);
    SavedState state = simulation.save();
    state.groups[1].velocities[4 * 17 + 1] = {0, 3e4f, 0};
    simulation.load(state);
    std::string message;
    try {
        simulation.frame();
        simulation.frame();
    } catch (const Runaway& runaway) {
        message = runaway.what();
    }
    for (const char* part : {"group \"many\", molecule 17, vertex ", " s: ", "m/s", "--substeps", "--solver",
                             "a field, a force, drag", "stopped at frame "})
        CHECK_THAT(message, Catch::Contains(part));
}

TEST_CASE("healthy runs raise nothing, whatever their number", "[watchdog]") {
    for (const Way& way : ways()) {
        for (const int count : {1, 63, 65, 1023, 1025}) {
            INFO(way.name << ", " << count);
            Scene scene = swarm(shippedMolecule("leaf"), count, SolverKind::euler, {0, 1.5, 0});
            scene.colliders = {everyCollider()[0], everyCollider()[1]};
            // Lanes past the last molecule would meet this wind if they worked at the origin, where no
            // molecule is.
            Field trap = test::field(UniformField{{1e7, 0, 0}});
            trap.box = Box{glm::dvec3(-0.5), glm::dvec3(0.5)};
            scene.fields = {trap};
            scene.groups[0].place.box = {{30, 1, 0}, {34, 5, 4}};
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].drag = {3, 1};
            scene.groups[0].velocity = {0, 300, 0};  // fast, but legal
            setStableSubsteps(scene);
            const Plan plan = compile(scene);
            Simulation simulation = make(plan, way.options);
            // invocations past the last molecule would raise an alarm in the first frame
            CHECK_FALSE(alarmOf(simulation, 20));
        }
    }
}

TEST_CASE("without a watchdog a run goes on, bit for bit the same", "[watchdog]") {
    const Plan plan = manyQuads(200);
    for (Way way : ways()) {
        INFO(way.name);
        Simulation watched = make(plan, way.options);
        way.options.watchdog = false;
        Simulation unwatched = make(plan, way.options);
        run(watched, 20);
        run(unwatched, 20);
        CHECK(watched.hash() == unwatched.hash());
        SavedState state = unwatched.save();
        state.groups[0].velocities[0].x = std::numeric_limits<float>::infinity();
        unwatched.load(state);
        CHECK_FALSE(alarmOf(unwatched, 3));
    }
}

TEST_CASE("the state before the last frame is exactly what it was", "[watchdog]") {
    if (!canFuse()) return;
    // anchors that move, pins that are released at random and by force
    for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
        Molecule molecule = shippedMolecule("leaf");
        molecule.vertices[0].pinned = molecule.vertices[2].pinned = true;
        Scene scene = swarm(molecule, 150, SolverKind::leapfrog, {0, 3, 0});
        scene.gravity = {0, -9.81, 0};
        scene.fields = {test::field(UniformField{{60, 0, 10}})};
        scene.groups[0].drag = {6, 1};
        scene.groups[0].release = Release{5.0, 2.0, 0.1};
        setStableSubsteps(scene);
        const Plan plan = compile(scene);
        Simulation simulation = make(plan, {.path = Path::fused, .lanes = lanes});
        CHECK_FALSE(simulation.saveBefore());
        int releases = 0, moves = 0;
        SavedState last = simulation.save();
        for (int frame = 0; frame < 60; ++frame) {
            simulation.frame();
            const std::optional<SavedState> before = simulation.saveBefore();
            REQUIRE(before);
            INFO(name(lanes) << ", frame " << frame);
            CHECK(before->groups == last.groups);
            CHECK(before->time == last.time);
            CHECK(before->frames == last.frames);
            CHECK(before->step == last.step);
            const SavedState now = simulation.save();
            for (size_t m = 0; m < 150; ++m) {
                releases += now.groups[0].released[m] != last.groups[0].released[m];
                moves += now.groups[0].anchors[m] != last.groups[0].anchors[m];
            }
            last = now;
        }
        CHECK(releases > 50);
        CHECK(moves > 500);
    }
}

TEST_CASE("a device that is lost ends a run in one line", "[watchdog]") {
    if (!testContext().info().atLeast(4, 5)) return;
    Simulation simulation = make(manyQuads(10), {.path = testPath()});
    simulation.frame();
    const auto before = __glewGetGraphicsResetStatus;
    __glewGetGraphicsResetStatus = []() -> GLenum { return GL_GUILTY_CONTEXT_RESET; };
    CHECK(messageOf([&] { simulation.frame(); }) ==
          "the device was lost: the driver reset it, for what this program did");
    __glewGetGraphicsResetStatus = before;
    CHECK(simulation.frames() == 1);
    CHECK_NOTHROW(simulation.frame());
}

TEST_CASE("a run that blows up is stopped before it is lost", "[watchdog]") {
    const Plan plan = manyQuads(100);
    std::optional<int> stopped;
    for (const Way& way : ways()) {
        INFO(way.name);
        Simulation simulation = make(plan, way.options);
        simulation.parameters.stiffness = 1e4;  // far beyond the stable step
        const std::optional<Alarm> alarm = alarmOf(simulation, 200);
        REQUIRE(alarm);
        // at the same frame, however late it is noticed
        if (way.options.path == Path::fused)
            CHECK(simulation.frames() == stopped.value_or(simulation.frames()));
        if (way.options.path == Path::fused) stopped = simulation.frames();
        const std::optional<SavedState> before = simulation.saveBefore();
        CHECK(before.has_value() == hasTwoSides(way.options));
        if (!before) continue;
        CHECK_FALSE(runsAway(findAlarm(*before)));
        // the same again from there
        Simulation again = make(plan, way.options);
        again.parameters = simulation.parameters;
        again.load(*before);
        const std::optional<Alarm> second = alarmOf(again);
        REQUIRE(second);
        CHECK(second->frame == alarm->frame);
        CHECK(second->molecule == alarm->molecule);
        CHECK(second->vertex == alarm->vertex);
        again.load(*before);
        again.parameters = parametersOf(plan);
        again.parameters.substeps *= 4;
        CHECK_FALSE(alarmOf(again));
    }
}

TEST_CASE("watching costs a few bytes of control a frame and none of state", "[watchdog][traffic]") {
    using Kind = gpu::Traffic::Kind;
    const Plan plan = manyQuads(300);
    for (const Way& way : ways()) {
        Simulation simulation = make(plan, way.options);
        run(simulation, 2);
        const gpu::Traffic before = testContext().traffic();
        run(simulation, 10);
        const gpu::Traffic traffic = testContext().traffic() - before;
        CHECK(traffic.total(Kind::state) == 0);
        CHECK(traffic.total(Kind::parameters) == 0);
        CHECK(traffic.down(Kind::control) == 40);
        CHECK(traffic.up(Kind::control) == 0);
    }
}

// Reports, and fails on nothing: shoal-gl "[watchdog-cost]". Processor time, because others may use the
// machine.
TEST_CASE("what watching costs", "[.watchdog-cost]") {
    Scene scene = swarm(shippedMolecule("quad"), 131072, SolverKind::euler);
    scene.groups[0].place.box = {{-20, 0.2, -20}, {20, 6, 20}};
    scene.groups[0].place.scale = {1, 1};
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].drag = {1, 1};
    scene.fields = {test::field(UniformField{{2, 0, 0.5}})};
    scene.colliders.resize(1);
    scene.solver.substeps = 4;
    const Plan plan = compile(scene);
    for (const Way& way : ways()) {
        if (way.options.lanes == Lanes::vertex) continue;
        const int frames = way.options.path == Path::pingPong ? 1 : 20;
        SimulationOptions options[2] = {way.options, way.options};
        options[0].watchdog = false;
        options[0].drawn = options[1].drawn = false;
        Simulation without = make(plan, options[0]), with = make(plan, options[1]);
        Simulation* const both[2] = {&without, &with};
        std::vector<double> times[2];
        for (int round = 0; round < 2 * 40; ++round) {
            const size_t one = size_t(round + round / 2) % 2;
            if (round % 8 == 0) without.restart(), with.restart();
            glFinish();
            const std::clock_t start = std::clock();
            run(*both[one], frames);
            glFinish();
            times[one].push_back(double(std::clock() - start) / CLOCKS_PER_SEC / frames / 131072 * 1e9);
        }
        // pairs that did the same frames
        std::vector<double> ratios;
        for (size_t i = 0; i < times[0].size(); ++i)
            ratios.push_back(times[1][i] / times[0][i]);
        for (std::vector<double>* all : {&times[0], &times[1], &ratios})
            std::sort(all->begin(), all->end());
        const auto middle = [](const std::vector<double>& all) { return all[all.size() / 2]; };
        const auto of = [&](size_t i) { return concat(times[i].front(), " / ", middle(times[i])); };
        WARN(way.name << ", ns of the processor a quad and frame, minimum / median: without " << of(0)
                      << ", with " << of(1) << "; median of the ratios " << middle(ratios));
    }
}
