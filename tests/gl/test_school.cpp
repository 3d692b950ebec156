// Schools (docs/school.md): what steers each against all pairs in double precision; that it repeats, goes on
// from a checkpoint, holds its limits, and swims, turns and stays upright.
#include <algorithm>
#include <cmath>

#include "author/shapes.h"
#include "compile/plan.h"
#include "gl/births.h"
#include "gl/feature_scenes.h"
#include "gl/gl_test.h"
#include "gl/school_reference.h"
#include "simulate/checkpoint.h"
#include "simulate/simulation.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

constexpr double frameTime = 1.0 / 60;

bool canRun() {
    if (testPath() != Path::pingPong) return true;
    WARN("skipped: schools need the fused path");
    return false;
}

Group fish(const std::string& name, int count, const glm::dvec3& half) {
    Group group;
    group.name = name;
    group.molecule = shippedMolecule("fry");
    group.count = count;
    group.place.kind = Placement::Kind::volume;
    group.place.box = {glm::dvec3(0, 2, 0) - half, glm::dvec3(0, 2, 0) + half};
    group.place.turn = Placement::Turn::yaw;
    group.drag = {40, 1};
    group.school = School{};
    return group;
}

Scene water() {
    Scene scene;
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 5;
    return scene;
}

// Two schools and three that hunt the first, between a plane and a sphere.
Scene pond(int count) {
    Scene scene = water();
    scene.groups = {fish("fry", count, {0.7, 0.4, 0.7}), fish("minnows", count / 2 + 3, {0.6, 0.5, 0.6}),
                    fish("hunters", 3, {1.5, 0.5, 1.5})};
    scene.groups[0].school->flees = {{"hunters", 1.2, 6, {}}};
    scene.groups[0].school->depth = glm::dvec2(1.9, 2.1);
    scene.groups[1].school->home = SchoolHome{Box{{-0.4, 1.8, -0.4}, {0.4, 2.2, 0.4}}, {}, 0, 3};
    scene.groups[1].school->flees = {{"hunters", 0.8, 3, {}}, {"fry", 0.15, 1, {}}};
    scene.groups[1].school->radius = 0.3;
    scene.groups[1].place.scale = {0.8, 1.2};
    School& hunters = *scene.groups[2].school;
    hunters.hunts = {{"fry", 3, 2, {}}};
    hunters.home = SchoolHome{{}, {0, 2, 0}, 1, 2};
    hunters.blind = 1.2;
    Collider ground, rock;
    ground.shape = PlaneCollider{{0, 1.5, 0}, {0, 1, 0}};
    rock.shape = SphereCollider{{0.5, 1.8, 0.4}, 0.3};
    scene.colliders = {ground, rock};
    return scene;
}

struct Run {
    explicit Run(const Scene& scene, SimulationOptions options = {})
        : simulation(testContext(), compile(scene), fused(options)) {}
    static SimulationOptions fused(SimulationOptions options) {
        options.path = Path::fused;
        options.drawn = false;
        return options;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i)
            simulation.frame();
    }
    Simulation simulation;
};

// The mean of a group's bodies.
struct Mean {
    double speed = 0, upright = 1, aligned = 0;
    glm::dvec3 place{0};
};

Mean meanOf(const Scene& scene, const Simulation& simulation, size_t group) {
    const SchoolReference reference(scene, simulation.plan());
    const auto bodies = reference.bodies(group, simulation.save().groups[group]);
    Mean out;
    for (const SchoolBody& body : bodies) {
        const double share = 1.0 / double(bodies.size());
        out.place += share * body.place;
        out.speed += share * glm::dot(body.velocity, body.forward);
        out.aligned += share * glm::dot(body.velocity, body.forward) / glm::length(body.velocity);
        out.upright = std::min(out.upright, body.upper.y);
    }
    return out;
}

}  // namespace

// Runs a pond and compares what steers each with all pairs. `ofHunters`: the share that theirs may be off by.
static void compareWithAllPairs(const Scene& scene, double ofHunters) {
    Run run(scene);
    for (const int frames : {0, 20, 20}) {
        run.frames(frames);
        const SavedState before = run.simulation.save();
        run.frames(1);
        const SavedState after = run.simulation.save();
        const SchoolReference reference(scene, run.simulation.plan());
        for (size_t g = 0; g < scene.groups.size(); ++g) {
            const std::vector<Steered> expected = reference.steer(g, before, frameTime);
            double worst[3] = {}, most[3] = {};
            int others = 0;
            for (size_t m = 0; m < expected.size(); ++m) {
                others += expected[m].others;
                for (size_t k = 0; k < 3; ++k) {
                    const glm::dvec4 found = after.groups[g].steering[3 * m + k];
                    worst[k] = std::max(worst[k], glm::length(glm::dvec3(found - expected[m].record[k])));
                    if (k != 2 || std::abs(found.w - expected[m].record[k].w) < 0.1)  // the clock's round
                        worst[k] = std::max(worst[k], std::abs(found.w - expected[m].record[k].w));
                    most[k] = std::max(most[k], glm::length(expected[m].record[k]));
                }
            }
            INFO("group " << g << ", frame " << after.frames << ", others " << others);
            if (g < 2) CHECK(others > 3 * int(expected.size()));
            // single precision: sums of some 50 vectors, and angles from a cross product
            const double share = g < 2 ? 1e-3 : ofHunters;
            for (size_t k = 0; k < 3; ++k) {
                INFO("record " << k << ": off by " << worst[k] << " of " << most[k]);
                CHECK(most[k] > 0.1);
                CHECK(worst[k] < share * most[k]);
            }
        }
    }
}

TEST_CASE("Each steers as all pairs say, among two schools, hunters and walls", "[school]") {
    if (!canRun()) return;
    Scene scene = pond(300);
    compareWithAllPairs(scene, 0.2);  // hunters look at every seventh of a run of 300
    scene.groups[2].school->hunts[0].radius = 0.3;
    compareWithAllPairs(scene, 1e-3);  // at all of the few that are near
}

TEST_CASE("A school repeats bit for bit, and goes on from a checkpoint and a restart", "[school]") {
    if (!canRun()) return;
    const Scene scene = pond(201);
    Run run(scene), again(scene);
    const uint64_t start = run.simulation.hash();
    run.frames(20);
    again.frames(20);
    CHECK(run.simulation.hash() != start);
    CHECK(run.simulation.hash() == again.simulation.hash());
    const Scratch scratch;
    writeCheckpoint(scratch.path("s.shoal"), run.simulation.plan(),
                    {run.simulation.save(), run.simulation.parameters});
    run.frames(15);
    Run later(scene);
    later.simulation.load(readCheckpoint(scratch.path("s.shoal"), later.simulation.plan()).state);
    later.frames(15);
    CHECK(later.simulation.hash() == run.simulation.hash());
    again.simulation.restart();
    again.frames(35);
    CHECK(again.simulation.hash() == run.simulation.hash());
}

TEST_CASE("Speeds and turns keep to their limits, bodies to their course, and all stay upright", "[school]") {
    if (!canRun()) return;
    const Scene scene = pond(120);
    Run run(scene);
    run.frames(60);
    const SchoolReference reference(scene, run.simulation.plan());
    // A molecule that runs into the rock is knocked over for a moment, and turns faster than it would by
    // itself.
    int all = 0, tilted = 0, knocked = 0;
    std::vector<std::vector<bool>> wereOver(2);
    for (int frame = 0; frame < 120; frame += 10) {
        run.frames(10);
        const SavedState state = run.simulation.save();
        for (size_t g = 0; g < 2; ++g) {
            const School& school = *scene.groups[g].school;
            const std::vector<SchoolBody> bodies = reference.bodies(g, state.groups[g]);
            wereOver[g].resize(bodies.size());
            for (size_t m = 0; m < bodies.size(); ++m) {
                const SchoolBody& body = bodies[m];
                CHECK(glm::dot(body.velocity, body.forward) < 1.1 * school.fastest);
                ++all;
                tilted += body.upper.y < 0.5;
                // what the body's wave adds to its turn is at most that of its head's swing
                knocked += glm::length(body.spin) > school.turn + 8;
                const bool over = body.upper.y < 0;
                CHECK_FALSE((over && wereOver[g][m]));  // ten frames later it stands again
                wereOver[g][m] = over;
            }
            for (const glm::vec4& one : state.groups[g].steering)
                CHECK((std::isfinite(one.x + one.y + one.z + one.w)));
        }
    }
    INFO(tilted << " tilted and " << knocked << " knocked of " << all);
    CHECK(tilted < 0.02 * all);
    CHECK(knocked < 0.01 * all);
    CHECK(meanOf(scene, run.simulation, 0).aligned > 0.9);
}

// Walls, others and wandering ask for any direction.
TEST_CASE("None swims steeper than it may, in a box for 20 s", "[school]") {
    if (!canRun()) return;
    Scene scene = water();
    scene.groups = {fish("fry", 100, {0.6, 0.3, 0.6})};
    School& school = *scene.groups[0].school;
    school.steepest = 0.35;
    for (int wall = 0; wall < 6; ++wall) {
        glm::dvec3 inwards(0);
        inwards[wall / 2] = wall % 2 == 0 ? 1 : -1;
        const glm::dvec3 half(1, 0.5, 1);
        scene.colliders.push_back({.name = concat("wall ", wall),
                                   .shape = PlaneCollider{glm::dvec3(0, 2, 0) - inwards * half, inwards}});
    }
    Run run(scene);
    const SchoolReference reference(scene, run.simulation.plan());
    double steepest = 0, farthest = 0;
    for (int frame = 0; frame < 1200; frame += 5) {
        run.frames(5);
        for (const SchoolBody& body : reference.bodies(0, run.simulation.save().groups[0])) {
            steepest = std::max(steepest, std::asin(std::abs(body.forward.y)));
            const glm::dvec3 off = glm::abs(body.place - glm::dvec3(0, 2, 0));
            farthest = std::max(farthest, std::max(std::max(off.x, off.z), off.y + 0.5));
        }
    }
    INFO("steepest " << steepest << " rad, at most " << farthest << " m from the middle");
    CHECK(steepest > 0.9 * school.steepest);  // it is asked for
    CHECK(steepest < school.steepest + 0.0175);
    CHECK(farthest < 1);
}

TEST_CASE("All in the same place part without NaN", "[school]") {
    if (!canRun()) return;
    Scene scene = water();
    scene.groups = {fish("fry", 70, {0, 0, 0})};
    Run run(scene);
    run.frames(1);
    const SavedState state = run.simulation.save();
    for (const glm::vec4& one : state.groups[0].steering)
        CHECK((std::isfinite(one.x + one.y + one.z + one.w)));
    run.frames(120);
    const Snapshot now = run.simulation.snapshot(0);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : now.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    CHECK(glm::length(high - low) > 0.5);
}

TEST_CASE("A hunter scatters those that it finds", "[school]") {
    if (!canRun()) return;
    const auto distance = [](bool flees) {
        Scene scene = water();
        scene.groups = {fish("fry", 150, {0.4, 0.2, 0.4}), fish("hunter", 1, {0, 0, 0})};
        if (flees) scene.groups[0].school->flees = {{"hunter", 1, 8, {}}};
        Run run(scene);
        run.frames(60);
        const SchoolReference reference(scene, run.simulation.plan());
        const SavedState state = run.simulation.save();
        const glm::dvec3 hunter = reference.bodies(1, state.groups[1])[0].place;
        double sum = 0;
        for (const SchoolBody& body : reference.bodies(0, state.groups[0]))
            sum += glm::distance(body.place, hunter) / 150;
        return sum;
    };
    const double fled = distance(true), stayed = distance(false);
    INFO("mean distance " << fled << " m, where none flees " << stayed << " m");
    CHECK(fled > stayed + 0.15);
}

// rad, between where they swim and where they look, on average.
static double offCourse(const Molecule& molecule) {
    Scene scene = water();
    scene.groups = {fish("fish", 100, {1.5, 0.5, 1.5})};
    scene.groups[0].molecule = molecule;
    setStableSubsteps(scene);
    Run run(scene);
    run.frames(120);
    const SchoolReference reference(scene, run.simulation.plan());
    const SavedState state = run.simulation.save();
    double sum = 0;
    for (const SchoolBody& body : reference.bodies(0, state.groups[0]))
        sum += std::acos(glm::dot(glm::normalize(body.velocity), body.forward)) / 100;
    return sum;
}

TEST_CASE("Fish of a shape swim ahead, as those that ship do", "[school]") {
    if (!canRun()) return;
    const Shape& shape = shapeNamed("fish");
    const Mesh mesh = shapeMesh(shape, shape.divisions);
    const double made = offCourse(makeMolecule(mesh, ofShape(shape, mesh, {})).molecule),
                 fry = offCourse(shippedMolecule("fry"));
    INFO("off course by " << made << " rad, fry by " << fry);
    CHECK(fry < 0.15);
    CHECK(made < 0.2);
}

TEST_CASE("One fish swims at its cruise, and turns by bending alone", "[school]") {
    if (!canRun()) return;
    Scene scene = water();
    scene.groups = {fish("fry", 1, {0, 0, 0})};
    scene.groups[0].place.turn = Placement::Turn::none;
    School& school = *scene.groups[0].school;
    school.wander = 0;
    Run straight(scene);
    straight.frames(180);
    const Mean swum = meanOf(scene, straight.simulation, 0);
    CHECK(swum.speed == Approx(school.cruise).epsilon(0.2));
    CHECK(swum.place.z > 0.8);  // along +Z
    CHECK(std::abs(swum.place.x) < 0.1);
    CHECK(swum.upright > 0.98);
    // to the left of it there is a home
    school.home = SchoolHome{{}, {3, 2, 0}, 0.1, 3};
    Run left(scene);
    left.frames(60);
    CHECK(meanOf(scene, left.simulation, 0).place.x > 0.1);
}

TEST_CASE("A school of points: one goes on at its cruise, turns to its home, and sees no dead", "[school]") {
    if (!canRun()) return;
    Scene scene = water();
    scene.groups = {fish("points", 1, {0, 0, 0})};
    Group& group = scene.groups[0];
    group.molecule = point(0.01);
    group.place.box = {glm::dvec3(0, 0, 0.1), glm::dvec3(0, 0, 0.1)};
    group.drag = {1, 1};
    group.velocity = {0, 0, group.school->cruise};
    group.school->wander = 0;
    Run straight(scene);
    straight.frames(120);
    const Snapshot swum = straight.simulation.snapshot(0);
    CHECK(swum.velocities[0].z == Approx(group.school->cruise).epsilon(0.02));
    CHECK(std::abs(swum.velocities[0].x) < 1e-3);
    // another lies dead in front of it
    group.life.emplace().capacity = 2;
    group.count = 2;
    group.place.box = {glm::dvec3(0), glm::dvec3(0)};
    group.place.items = {at({0, 0, 0.1}), at({0.05, 0, 0.2})};
    group.place.kind = Placement::Kind::list;
    for (const bool dead : {true, false}) {
        Run both(scene);
        SavedState state = both.simulation.save();
        if (dead) state.groups[0].lives[1] = {0, 0};
        both.simulation.load(state);
        both.frames(120);
        CHECK((glm::distance(both.simulation.snapshot(0).positions[0], swum.positions[0]) < 1e-4) == dead);
    }
    group.count = 1;
    group.place.items.resize(1);
    group.life.reset();
    group.school->home = SchoolHome{{}, {3, 0, 0}, 0.1, 3};
    Run left(scene);
    left.frames(60);
    CHECK(left.simulation.snapshot(0).positions[0].x > 0.05);
}

TEST_CASE("Other numbers take effect at once, and others' names do not", "[school]") {
    if (!canRun()) return;
    const Scene scene = pond(50);
    Run run(scene);
    run.frames(30);
    School school = *scene.groups[1].school;
    school.cruise = school.fastest = school.slowest = 0.2;
    CHECK(run.simulation.changeSchool(1, school));
    school.flees[0].group = "fry";
    CHECK_FALSE(run.simulation.changeSchool(1, school));
    run.frames(60);
    CHECK(meanOf(scene, run.simulation, 1).speed < 0.3);
    CHECK(meanOf(scene, run.simulation, 0).speed > 0.3);
}

TEST_CASE("Compute shaders and fragments steer and swim alike, and hand over to one another", "[school]") {
    if (!testContext().info().computeShaders || !canRun()) return;
    const Scene scene = pond(60);
    Run compute(scene);
    const Plan plan = compile(scene);
    Simulation fragments(testContext(), plan, {.drawn = false, .path = Path::fragments});
    for (const int frames : {0, 20}) {
        compute.frames(frames);
        fragments.load(compute.simulation.save());
        for (int i = 0; i < 3; ++i) {
            compute.simulation.frame();
            fragments.frame();
        }
        const SavedState a = compute.simulation.save(), b = fragments.save();
        for (size_t g = 0; g < a.groups.size(); ++g) {
            REQUIRE(b.groups[g].steering.size() == a.groups[g].steering.size());
            double apart = 0;
            for (size_t i = 0; i < a.groups[g].positions.size(); ++i)
                apart = std::max(apart,
                                 double(glm::distance(a.groups[g].positions[i], b.groups[g].positions[i])));
            CHECK(apart < 1e-5 * plan.groups[g].size);
            for (size_t i = 0; i < a.groups[g].steering.size(); ++i)
                for (int c = 0; c < 4; ++c)
                    REQUIRE(b.groups[g].steering[i][c] == Approx(a.groups[g].steering[i][c]).margin(1e-3));
        }
        compute.simulation.load(b);
    }
}

TEST_CASE("The ping-pong path says that it has no schools", "[school]") {
    const Scene scene = pond(5);
    SimulationOptions options;
    options.path = Path::pingPong;
    CHECK_THAT(messageOf([&] { Simulation(testContext(), compile(scene), options); }),
               Contains("schooling needs the fused path"));
}
