// A lane a vertex leaves the bits of a lane a molecule, whatever a group needs.
#include <GL/glew.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <set>

#include "gl/agreement.h"
#include "gl/births.h"
#include "gl/feature_scenes.h"
#include "gpu/pass_timers.h"
#include "molecule/molecule_file.h"
#include "scene/collider_kinds.h"
#include "scene/force_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Simulation on(const Plan& plan, Lanes lanes) {
    return Simulation(testContext(), plan, {.path = Path::fused, .lanes = lanes});
}

// One frame from the same state, to what roundings make of it.
void checkClose(Simulation& lane, Simulation& rows) {
    rows.load(lane.save());
    lane.frame();
    rows.frame();
    for (size_t g = 0; g < lane.plan().groups.size(); ++g) {
        const GroupPlan& group = lane.plan().groups[g];
        const Snapshot one = lane.snapshot(g), other = rows.snapshot(g);
        std::set<size_t> apart;  // molecules
        for (size_t i = 0; i < one.positions.size(); ++i)
            if (glm::distance(one.positions[i], other.positions[i]) > Agreement::tolerance * group.size)
                apart.insert(i / size_t(group.vertexCount));
        CHECK(int(apart.size()) <= 1 + group.count / 20);  // where a rounding decides what touches
        CHECK(one.released == other.released);
        CHECK(one.alive == other.alive);
    }
}

// So many frames in both forms, and what is left of each group.
void checkSame(const Scene& scene, int frames, const CompileOptions& options = {}) {
    const Plan plan = compile(scene, options);
    Simulation lane = on(plan, Lanes::molecule), rows = on(plan, Lanes::vertex);
    REQUIRE(rows.lanes(0) == Lanes::vertex);
    if (!keepsBits()) {
        for (int frame = 0; frame < frames; ++frame)
            checkClose(lane, rows);
        return;
    }
    test::run(lane, frames);
    test::run(rows, frames);
    const SavedState one = lane.save(), other = rows.save();
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        CHECK((one.groups[g].positions == other.groups[g].positions));
        CHECK((one.groups[g].velocities == other.groups[g].velocities));
        CHECK((one.groups[g] == other.groups[g]));
        CHECK((lane.snapshot(g).normals == rows.snapshot(g).normals));
    }
    CHECK(lane.hash() == rows.hash());
}

// Springs that are muscles, pins that are released, drag by direction, a plane and a field; molecules that
// differ in size and phase, and no multiple of a workgroup.
Scene fullScene(const Molecule& plain, SolverKind solver) {
    Molecule molecule = plain;
    addMuscles(molecule, 0.1);
    Scene scene = swarm(molecule, 67, solver, {0, 1.2, 0});
    scene.gravity = {0, -9.81, 0};
    scene.fields = {everyField()[0]};
    scene.colliders = {everyCollider()[0]};
    Group& group = scene.groups[0];
    group.drag = {3, 0.8};
    group.release = Release{20, 4, 0};
    group.phaseSpread = 3;
    setStableSubsteps(scene);
    return scene;
}

// Points in a row, with springs where asked for, each of which has its neighbours at both sides.
Molecule chain(int vertices, bool sprung) {
    Molecule out = sheet(vertices, 1, false);
    if (!sprung) out.springs.clear();
    return out;
}

}  // namespace

TEST_CASE("a lane a vertex leaves the bits of a lane a molecule with every explicit solver",
          "[fused][lanes]") {
    if (!canFuse()) return;
    // 15 vertices in eight rows: one place of the last row is over
    for (const SolverKind solver : explicitSolvers()) {
        INFO(name(solver));
        const Scene scene = fullScene(sheet(5, 3, true), solver);
        checkSame(scene, 12);
        Simulation rows = on(compile(scene), Lanes::vertex);
        test::run(rows, 12);
        const auto released = rows.save().groups[0].released;
        CHECK(std::count(released.begin(), released.end(), true) > 0);
        CHECK(std::count(released.begin(), released.end(), false) > 0);
    }
}

TEST_CASE("a lane a vertex samples fields, pushes and touches as a lane a molecule does", "[fused][lanes]") {
    if (!canFuse()) return;
    Scene forced = fullScene(sheet(3, 3, false), SolverKind::leapfrog);
    forced.solver.fieldSampling = FieldSampling::moleculeFrame;
    forced.colliders = {everyCollider()[0], everyCollider()[1]};  // several: along the way
    forced.colliders[1].path.emplace().keyframes = {{0, {}}, {1, {{0.3, 0.1, 0}}}};
    forced.forces = everyForce();
    forced.groups[0].release.reset();
    setStableSubsteps(forced);
    {
        INFO("forces, colliders that move");
        checkSame(forced, 12);
    }

    Scene high = fullScene(chain(7, true), SolverKind::euler);
    high.solver.fieldSampling = FieldSampling::vertexFrame;
    high.colliders = {everyCollider()[2]};  // kept from finding to answering
    {
        INFO("a height field");
        checkSame(high, 12);
    }

    for (const int vertices : {1, 12}) {
        INFO(vertices << " vertices without springs");
        checkSame(fullScene(vertices == 1 ? test::point(1) : chain(vertices, false), SolverKind::verlet), 6);
    }
}

TEST_CASE("schools, contact between molecules and live springs are the same with a lane a vertex",
          "[fused][lanes][school]") {
    if (!canFuse()) return;
    Molecule fry = shippedMolecule("fry");
    Scene school = swarm(fry, 45, SolverKind::leapfrog, {0, 2, 0});
    school.solver.substeps = 5;
    school.groups[0].drag = {40, 1};
    school.groups[0].school.emplace().bend = 1.5;
    school.groups[0].school->home = SchoolHome{{}, {0, 2, 0}, 0.1, 20};
    {
        INFO("school");
        checkSame(school, 5);
    }
    {
        INFO("school, live");
        checkSame(school, 3, {.liveSprings = true});
    }

    Scene heap = fullScene(sheet(3, 3, false), SolverKind::leapfrog);
    heap.groups[0].contact.emplace().radius = 0.1;
    heap.groups[0].release.reset();
    {
        INFO("contact");
        checkSame(heap, 6);
    }

    Scene live = fullScene(sheet(5, 3, true), SolverKind::leapfrog);
    const Plan plan = compile(live, {.liveSprings = true});
    Simulation lane = on(plan, Lanes::molecule), rows = on(plan, Lanes::vertex);
    Molecule& changed = live.groups[0].molecule;
    for (Spring& spring : changed.springs) {
        spring.stiffness *= 0.4;
        spring.restLength = 1.05 * changed.restLength(spring);
        if (spring.actuation) spring.actuation->frequency *= 1.5;
    }
    test::run(lane, 3);
    test::run(rows, 3);
    if (keepsBits()) CHECK(lane.hash() == rows.hash());
    REQUIRE(lane.changeSprings(0, changed));
    REQUIRE(rows.changeSprings(0, changed));
    if (!keepsBits()) return checkClose(lane, rows);
    test::run(lane, 3);
    test::run(rows, 3);
    CHECK(lane.hash() == rows.hash());
}

TEST_CASE("molecules are born and die alike with a lane a vertex", "[fused][lanes][births]") {
    if (!canFuse()) return;
    for (const int columns : {3, 4}) {  // age and life inside the state, and behind it
        INFO(columns * 2 << " vertices");
        Emitter emitter = steady(600);
        emitter.random = true;
        emitter.speed = {2, 8};
        emitter.spread = 1;
        Scene scene = emitting(emitter, 150, {0.1, 0.4});
        scene.gravity = {0, -9.81, 0};
        PlaneCollider plane;
        plane.point = {0, -0.2, 0};
        scene.colliders.emplace_back().shape = plane;
        Group& group = scene.groups[0];
        group.molecule = sheet(columns, 2, false);
        group.drag = {2, 0.5};
        group.life->within = Box{{-3, -1, -3}, {3, 0.4, 3}};
        group.life->afterContact = 0.05;
        setStableSubsteps(scene);
        checkSame(scene, 40);
        Simulation rows = on(compile(scene), Lanes::vertex);
        test::run(rows, 40);
        const LifeCounts counts = rows.lifeCounts(0);
        CHECK(counts.born > uint64_t(counts.live) + 50);
    }
}

TEST_CASE("by name a form refuses what it cannot hold, in one line", "[fused][lanes][errors]") {
    if (!canFuse()) return;
    const auto message = [](const Scene& scene, Lanes lanes) {
        return messageOf([&] { on(compile(scene), lanes); });
    };
    const Scene stiff = swarm(sheet(3, 3, false), 3, SolverKind::bdf2Xpbd);
    CHECK_THAT(message(stiff, Lanes::vertex),
               Catch::Contains("one after the other") && Catch::Contains("--lanes"));
    CHECK(on(compile(stiff), Lanes::automatic).lanes(0) == Lanes::molecule);
    const Scene large = swarm(chain(70, true), 3, SolverKind::leapfrog);
    CHECK_THAT(message(large, Lanes::molecule), Catch::Contains("a lane holds at most"));
    CHECK(on(compile(large), Lanes::automatic).lanes(0) == Lanes::vertex);
}

// Reports, and fails on nothing: shoal-gl "[.lanes-cost]". Seconds to the first frame without a cache, and
// processor time of a frame, because others may use the machine.
TEST_CASE("what the forms cost a CPU rasteriser", "[.lanes-cost]") {
    if (!canFuse() || !testContext().info().software) return;
    const auto seconds = [] { return double(std::clock()) / CLOCKS_PER_SEC; };
    for (const int vertices : {20, 24, 33, 48, 64}) {
        const int rows = vertices == 20 || vertices == 24 ? 4 : vertices == 33 ? 3 : vertices == 48 ? 6 : 8;
        for (const Molecule& shape :
             {chain(vertices, false), chain(vertices, true), sheet(vertices / rows, rows, false)}) {
            for (const bool plane : {false, true}) {
                Scene scene = swarm(shape, 4096, SolverKind::leapfrog);
                scene.gravity = {0, -9.81, 0};
                scene.fields = {test::field(UniformField{{2, 0, 0.5}})};
                scene.groups[0].drag = {6, 1};
                if (plane) scene.colliders.resize(1);
                scene.solver.substeps = 5;
                for (Spring& spring : scene.groups[0].molecule.springs)
                    spring.stiffness *= 0.01, spring.damping *= 0.01;
                const Plan plan = compile(scene);
                std::vector<std::unique_ptr<Simulation>> both;
                std::vector<double> starts, times[2];
                for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
                    const double start = seconds();
                    both.push_back(std::make_unique<Simulation>(
                        testContext(), plan, SimulationOptions{.path = Path::fused, .lanes = lanes}));
                    test::run(*both.back(), 1);
                    glFinish();
                    starts.push_back(seconds() - start);
                }
                for (int round = 0; round < 14; ++round) {
                    const size_t one = size_t(round + round / 2) % 2;
                    if (round % 4 == 0) both[0]->restart(), both[1]->restart();
                    glFinish();
                    const double start = seconds();
                    test::run(*both[one], 6);
                    glFinish();
                    times[one].push_back((seconds() - start) / 6 / 4096 * 1e9);
                }
                const auto text = [&](size_t i) {
                    std::sort(times[i].begin(), times[i].end());
                    return concat(starts[i], " s, ", times[i].front(), " / ", times[i][times[i].size() / 2]);
                };
                WARN(shape.name << ", " << shape.vertices.size() << " vertices, " << shape.springs.size()
                                << " springs" << (plane ? ", a plane" : "")
                                << ": to the first frame; ns a molecule and frame, minimum / median: lane a "
                                   "molecule "
                                << text(0) << "; lane a vertex " << text(1));
            }
        }
    }
}

// Reports, and fails on nothing: the same on a GPU, by its own clock.
TEST_CASE("what the forms cost a GPU", "[.lanes-cost]") {
    if (!canFuse() || testContext().info().software) return;
    const auto shipped = [](const char* name) {
        return readMolecule(concat(SHOAL_SOURCE_DIR "/molecules/", name, ".json"));
    };
    Molecule cloth = sheet(8, 8, false);
    for (Spring& spring : cloth.springs)
        spring.stiffness *= 0.01, spring.damping *= 0.01;
    enum { free, inTheAir, onTheGround };
    static constexpr const char* states[] = {"no collider", "a plane, in the air", "a plane, on the ground"};
    gpu::DeviceTimer timer;
    for (const Molecule& shape : {shipped("quad"), shipped("leaf"), shipped("cross"), shipped("fry"),
                                  shipped("fish"), sheet(8, 4, false), cloth}) {
        for (const int count : {16384, 131072, 1048576}) {
            if (shape.vertices.size() > 24 && count > 131072) continue;
            for (const int state : {free, inTheAir, onTheGround}) {
                Scene scene = swarm(shape, count, SolverKind::leapfrog);
                scene.gravity = {0, -9.81, 0};
                scene.fields = {test::field(UniformField{{2, 0, 0.5}})};
                scene.solver.substeps = 5;
                Group& group = scene.groups[0];
                group.drag = {6, 1};
                group.place.scale = {1, 1};
                if (state != free) {
                    PlaneCollider plane;
                    plane.point = {0, state == inTheAir ? -6 : 0, 0};
                    scene.colliders.emplace_back().shape = plane;
                    if (state == onTheGround) group.place.box.low.y = 0, group.place.box.high.y = 0.02;
                }
                const Plan plan = compile(scene);
                std::string line;
                for (const Lanes form : {Lanes::molecule, Lanes::vertex}) {
                    if (form == Lanes::molecule && !fitsLane(plan.groups[0])) continue;
                    const auto start = std::chrono::steady_clock::now();
                    Simulation simulation = on(plan, form);
                    test::run(simulation, 1);
                    glFinish();
                    const double first =
                        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
                    test::run(simulation, 10);
                    std::vector<double> times;
                    for (int round = 0; round < 8; ++round)
                        times.push_back(timer.secondsOf([&] { test::run(simulation, 2); }) / 2 * 1e3);
                    simulation.check();
                    std::sort(times.begin(), times.end());
                    line += concat("; a lane a ", name(form), " ", times.front(), " / ", times[4],
                                   " ms, first frame after ", first, " s");
                }
                WARN(shape.name << ", " << shape.vertices.size() << " vertices, " << shape.springs.size()
                                << " springs, " << count << ", " << states[state] << line);
            }
        }
    }
}
