// When there is no reference, or only a rough one.
#include <algorithm>
#include <cmath>
#include <ctime>

#include "compile/plan.h"
#include "measure/accuracy.h"
#include "measure/accuracy_reference.h"
#include "measure/calibrate.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace shoal::measure {

namespace {

// Returns the processor time since `start` in s, whatever else the machine does.
double secondsSince(std::clock_t start) {
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

// A leaf that spins, of masses 1.
Scene spinning(double stiffness) {
    Scene out;
    out.frameRate = 5;
    out.solver.kind = SolverKind::bdf2Xpbd;
    Group& group = out.groups.emplace_back();
    group.molecule = test::leaf(stiffness, 5);
    group.count = 2;
    group.spin = {12, 12.5, -10};
    return out;
}

// At the origin, thrown apart: what the reference makes of it counts, not where it is.
std::vector<Snapshot> startsOf(const Scene& scene) {
    Snapshot out;
    const Molecule& molecule = scene.groups[0].molecule;
    out.count = scene.groups[0].count;
    out.vertexCount = int(molecule.vertices.size());
    for (int m = 0; m < out.count; ++m) {
        for (const Vertex& vertex : molecule.vertices) {
            out.positions.push_back(vertex.position);
            out.velocities.push_back(vertex.position * (0.1 * (m + 1)));
        }
    }
    return {out};
}

}  // namespace

// Without a context: it would be needed to make a method ready.
TEST_CASE("a scene that the reference does not know is refused before anything is made ready", "[accuracy]") {
    Scene scene = spinning(1e4);
    scene.groups[0].life.emplace().location = {"flock.scene.json", 3, 5, "$.groups[0].life"};
    const auto refusal = Catch::StartsWith("flock.scene.json:3:5: the reference knows no births and deaths");
    CHECK_THROWS_WITH(calibrate(scene, {}, {}), refusal);
    CHECK_THROWS_WITH(measureAccuracy(scene, {}, {}), refusal);
    scene.groups.clear();
    CHECK_THROWS_WITH(calibrate(scene, {}, {}), Catch::Contains("no molecules to measure"));
}

TEST_CASE("a reference ends when its time is over", "[accuracy]") {
    const Molecule molecule = test::pair(0.01, 0.01, 1e12, 0);
    const reference::Problem problem{.molecule = &molecule};
    const reference::State start = reference::restState(problem);
    const std::clock_t begin = std::clock();
    const reference::Solution stiff = reference::solve(problem, start, 1, 1e-6, 12, 0.05);
    CHECK(secondsSince(begin) < 5);
    CHECK_FALSE(stiff.converged);
    CHECK(stiff.ended == reference::Ended::outOfTime);
    CHECK(std::isinf(stiff.error));

    const Molecule soft = test::pair(1, 1, 10, 0);
    const reference::Problem easy{.molecule = &soft};
    reference::State drawn = reference::restState(easy);
    drawn.position[1].x += 0.1;
    const reference::Solution none = reference::solve(easy, drawn, 1, 1e-6, 0);
    CHECK(none.ended == reference::Ended::outOfHalvings);
    CHECK(std::isinf(none.error));
    CHECK(none.state.time == Approx(1));
    const reference::Solution one = reference::solve(easy, drawn, 1, 1e-15, 1);
    CHECK(one.ended == reference::Ended::outOfHalvings);
    CHECK(one.error < 0.01);
}

TEST_CASE("a scene that is too stiff for a reference is called so", "[accuracy]") {
    const Scene scene = spinning(1e14);
    const Plan plan = compile(scene);
    ExactEnds ends(scene, plan, startsOf(scene), 1, 2, 2);
    const std::clock_t begin = std::clock();
    CHECK(ends.solve(1e-5, 0.2) == Settled::tooStiff);
    CHECK(secondsSince(begin) < 5);
    CHECK_THAT(ends.why(), Catch::Contains("too stiff for a reference in 0.2 s"));
    CHECK(ends.secondsToSolve(0.2) <= 0.2 * 2);
}

TEST_CASE("a reference that ran out of time is rough, not chaotic", "[accuracy]") {
    const Scene scene = spinning(1e4);
    const Plan plan = compile(scene);
    ExactEnds ends(scene, plan, startsOf(scene), 1, 1, 1);
    Settled settled = Settled::tooStiff;
    double seconds = 1e-5;
    for (; settled == Settled::tooStiff; seconds *= 1.5)
        settled = ends.solve(ExactEnds::floor, seconds);
    CHECK((settled == Settled::roughly || settled == Settled::yes));
    CHECK(ends.error() < ExactEnds::mostChange);
    if (settled == Settled::roughly) CHECK_THAT(ends.why(), Catch::Contains("which is as far as"));
    // more time: nearer, and it stays
    CHECK(ends.solve(ExactEnds::floor, 60) == Settled::yes);
    CHECK(ends.error() <= ExactEnds::floor);
}

}  // namespace shoal::measure
