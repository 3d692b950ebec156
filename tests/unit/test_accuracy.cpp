// The pure parts of `shoal measure`: the front, what an error costs, the ladder of steps, the tables, the
// report's scenes.
#include <algorithm>
#include <cmath>
#include <set>

#include "compile/plan.h"
#include "measure/accuracy.h"
#include "measure/calibrate.h"
#include "measure/method_runner.h"
#include "measure/report_scenes.h"
#include "reference/fields.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

namespace shoal::measure {

namespace {

AccuracyPoint point(SolverKind solver, int substeps, double time, double error,
                    FieldSampling sampling = FieldSampling::vertexSubstep) {
    AccuracyPoint out;
    out.method = {solver, sampling};
    out.step.substeps = substeps;
    out.stepsPerSecond = 60.0 * substeps;
    out.outcome = Outcome::measured;
    out.error = ErrorParts{error};
    out.time = {time, time, 3};
    return out;
}

// euler: error 1 / n at a time of n; leapfrog: 1 / n^2 at 2 n.
std::vector<AccuracyPoint> twoCurves() {
    std::vector<AccuracyPoint> out;
    for (int n = 1; n <= 1024; n *= 2)
        out.push_back(point(SolverKind::euler, n, n, 1.0 / n));
    for (int n = 1; n <= 1024; n *= 2)
        out.push_back(point(SolverKind::leapfrog, n, 2.0 * n, 1.0 / n / n));
    return out;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> out(1);
    for (const char c : text) {
        if (c == '\n')
            out.emplace_back();
        else
            out.back() += c;
    }
    out.pop_back();
    return out;
}

}  // namespace

TEST_CASE("the Pareto front", "[accuracy]") {
    CHECK(paretoFront({}).empty());
    // dominated in both; equal twins, of which the first stays; equal times; equal errors
    const std::vector<std::pair<double, double>> points = {{3, 3}, {1, 5},   {2, 2},   {1, 5},
                                                           {2, 4}, {5, 0.5}, {6, 0.5}, {4, 2}};
    CHECK(paretoFront(points) == std::vector<size_t>{1, 2, 5});

    std::vector<AccuracyPoint> all = twoCurves();
    all.push_back(point(SolverKind::rk4, 1, 0.1, 1e-9));
    all.back().time = {};  // not timed: no point of the front
    all.push_back(point(SolverKind::rk4, 2, 0.1, 1e-9));
    all.back().error.reset();
    markFront(all);
    for (const AccuracyPoint& one : all) {
        CAPTURE(measure::name(one.method), one.step.substeps);
        // at (4, 1/4) the two meet, and the first stays
        const bool front = one.method.solver == SolverKind::euler
                               ? one.step.substeps <= 4
                               : one.method.solver == SolverKind::leapfrog && one.step.substeps >= 4;
        CHECK(one.front == front);
    }
}

TEST_CASE("what an error costs is interpolated between logarithms", "[accuracy]") {
    const std::vector<Sample> curve = curveOf(twoCurves(), {SolverKind::leapfrog, {}});
    REQUIRE(curve.size() == 11);
    const std::optional<AtError> between = costAt(curve, 1e-3);
    REQUIRE(between);
    CHECK_FALSE(between->atLargestStep);
    CHECK(between->time == Approx(2 * std::sqrt(1e3)));
    CHECK(between->stepsPerSecond == Approx(60 * std::sqrt(1e3)));
    // a point itself, as far as logarithms are exact
    CHECK(costAt(curve, 1.0 / 16)->time == Approx(8));
    // the largest step will do; nothing will
    CHECK(costAt(curve, 2)->atLargestStep);
    CHECK(costAt(curve, 2)->time == 2);
    CHECK_FALSE(costAt(curve, 1e-9));
    CHECK_FALSE(costAt({}, 1));
    // of two crossings the cheaper: floats may spoil fine steps
    const std::vector<Sample> wavy = {{1, 1, 1}, {2, 0.1, 2}, {4, 1, 4}, {8, 0.1, 8}};
    CHECK(costAt(wavy, 0.1)->time == Approx(2));
    // an error of 0 is no logarithm
    std::vector<AccuracyPoint> exact = {point(SolverKind::leapfrog, 1, 1, 0.1),
                                        point(SolverKind::leapfrog, 2, 2, 0)};
    CHECK(std::isfinite(costAt(curveOf(exact, exact[0].method), 1e-3)->time));
}

TEST_CASE("a method is left out only when it is dearer each time that both are timed in turn", "[accuracy]") {
    int timed = 0;
    const auto always = [&](double seconds) {
        return [&timed, seconds] {
            ++timed;
            return seconds;
        };
    };
    // 50 times as dear at first sight, because something else ran
    double challenger = 50, best = 1;
    CHECK_FALSE(losesAgain(challenger, best, always(0.9), always(1)));
    CHECK(challenger == 0.9);
    // noise twice in a row
    int call = 0;
    challenger = 50;
    CHECK_FALSE(losesAgain(
        challenger, best, [&] { return ++call < 3 ? 2 : 0.9; }, always(1)));
    // the best one's time was too good... and one that is really dearer stays so, without much ado
    challenger = 50;
    timed = 0;
    CHECK(losesAgain(challenger, best, always(50), always(1)));
    CHECK(timed == 2);
    challenger = 1.2;
    CHECK(losesAgain(challenger, best, always(1.2), always(1)));
    // nothing is timed where it wins
    timed = 0;
    challenger = 0.5;
    CHECK_FALSE(losesAgain(challenger, best, always(9), always(9)));
    CHECK(timed == 0);
}

TEST_CASE("an error is claimed of a sample that shows what one of a hundred molecules does", "[accuracy]") {
    CHECK(1 - std::pow(0.99, sampleMolecules) > 0.95);
    CHECK(SampleError{.rms = 5e-5, .worst = 1e-4, .measured = 300}.holds(1e-3));
    CHECK_FALSE(SampleError{}.holds(1e-3));
    // 12 of 400 end elsewhere
    CHECK_FALSE(SampleError{.rms = 3.9e-2, .worst = 0.36, .measured = 300, .above = 9}.holds(1e-3));
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 2e-3, .measured = 300, .above = 9}.holds(1e-3));
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 1.2e-2, .measured = 300, .above = 1}.holds(1e-3));
    CHECK(SampleError{.rms = 9e-4, .worst = 2e-3, .measured = 300, .above = 3}.holds(1e-3));
    // of few molecules none may be above
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 2e-3, .measured = 20, .above = 1}.holds(1e-3));
}

TEST_CASE("the best field sampling of a solver", "[accuracy]") {
    std::vector<AccuracyPoint> points = twoCurves();
    points.push_back(point(SolverKind::leapfrog, 1, 1.5, 1e-4, FieldSampling::vertexFrame));
    CHECK(bestOf(points, SolverKind::leapfrog, 1e-3)->method.sampling == FieldSampling::vertexFrame);
    CHECK(bestOf(points, SolverKind::leapfrog, 1e-5)->method.sampling == FieldSampling::vertexSubstep);
    CHECK_FALSE(bestOf(points, SolverKind::rk4, 1));
}

TEST_CASE("the ladder of steps", "[accuracy]") {
    const std::vector<Step> coarse = stepLadder(false, 16);
    REQUIRE(coarse.size() == 14);
    for (size_t i = 0; i < coarse.size(); ++i) {
        CHECK(coarse[i].perFrame() == 1 << i);
        CHECK(coarse[i].substeps <= maxSubsteps);
        CHECK((coarse[i].split == 1) == (i < 10));
    }
    CHECK(stepLadder(false, 1).back() == Step{512, 1});
    const std::vector<Step> fine = stepLadder(true, 4);
    for (size_t i = 1; i < fine.size(); ++i)
        CHECK(fine[i].perFrame() > fine[i - 1].perFrame());
    CHECK(fine[3] == Step{4, 1});
    CHECK(fine[4] == Step{6, 1});
}

TEST_CASE("times end when their seconds are over, and say by the first round what has none", "[accuracy]") {
    // a clock of its own: each visit takes `slow` times what was expected of it
    const std::vector<double> cost = {0.01, 0.02, 0.1, 0.5, 1, 4};
    CHECK(thoseThatFit(cost, 0.2) == std::vector<bool>{true, true, true, false, false, false});
    CHECK(thoseThatFit({4, 0.5, 1}, 2) == std::vector<bool>{false, true, true});
    CHECK(thoseThatFit(cost, {}) == std::vector<bool>(6, true));
    for (const double slow : {0.5, 1.0, 5.0}) {
        for (const double seconds : {0.3, 6.0, 60.0}) {
            CAPTURE(slow, seconds);
            double clock = 100;
            std::vector<int> visits(cost.size());
            visitInTurn(
                cost, seconds, [&] { return clock; },
                [&](size_t i) {
                    clock += slow * cost[i];
                    ++visits[i];
                });
            // at most the first visit of one that is slower than expected goes beyond
            CHECK(clock - 100 <= seconds + std::max(0.0, slow - 1) * cost.back());
            CHECK(visits[0] > 0);
            if (slow <= 1 && seconds >= 6)
                CHECK(std::all_of(visits.begin(), visits.end(), [](int n) { return n > 0; }));
        }
    }
}

TEST_CASE("field samplings that differ", "[accuracy]") {
    Scene scene;
    scene.groups.emplace_back().drag = {1, 1};
    CHECK(samplingsThatDiffer(scene).size() == 1);
    scene.fields.emplace_back().shape = UniformField{{1, 0, 0}};
    CHECK(samplingsThatDiffer(scene).size() == 1);
    scene.fields[0].box.emplace();
    CHECK(samplingsThatDiffer(scene).size() == 3);
    scene.fields[0].box.reset();
    scene.fields.emplace_back().shape = ShearField{};
    CHECK(samplingsThatDiffer(scene).size() == 3);
    scene.groups[0].drag = {};
    CHECK(samplingsThatDiffer(scene).size() == 1);
}

TEST_CASE("tables of speed-ups", "[accuracy]") {
    std::vector<ReportEntry> entries(4);
    for (size_t i = 0; i < entries.size(); ++i) {
        entries[i].molecule = "leaf";
        entries[i].motion = "fall";
        entries[i].stiffness = reportStiffnesses[i];
    }
    entries[0].accuracy.points = twoCurves();
    entries[1].accuracy.chaotic = "so it is";
    entries[2].accuracy.points = {point(SolverKind::rk4, 1, 1, 1e-6)};
    const std::vector<std::string> speedUps = lines(speedUpTable(entries, 1e-2));
    REQUIRE(speedUps.size() == 3);
    CHECK(speedUps[0] == "| motion, molecule | k = 1e2 | k = 1e4 | k = 1e6 | k = 1e8 |");
    // euler 100, leapfrog 20
    CHECK(speedUps[2] == "| fall, leaf | leapfrog 5.0× | chaotic | rk4; euler not reached | not reached |");

    const std::vector<std::string> costs = lines(costTable(entries, 1e-2));
    REQUIRE(costs.size() == 5);
    CHECK_THAT(costs[2], Catch::Contains("fall, leaf, k = 1e2 |"));
    CHECK_THAT(costs[3], Catch::Contains("| ≤ ") && Catch::Contains("not reached"));

    entries[0].chosen.emplace();
    entries[0].chosen->method = {SolverKind::leapfrog, FieldSampling::vertexFrame};
    entries[0].chosen->substeps = 7;
    CHECK_THAT(chosenTable(entries), Catch::Contains("| leapfrog (vertexFrame) 7 | none |"));
}

TEST_CASE("the report's scenes are those of the numbers they quote", "[accuracy]") {
    CHECK((foldedLeaf(1).vertices.size() == 4 && foldedLeaf(1).springs.size() == 6));
    CHECK((bracedCross(1).vertices.size() == 10 && bracedCross(1).springs.size() == 29));
    CHECK((slenderFish(1).vertices.size() == 24 && slenderFish(1).springs.size() == 96));
    for (const Molecule& molecule : {foldedLeaf(1e4), bracedCross(1e4), slenderFish(1e4)}) {
        CAPTURE(molecule.name);
        std::set<std::pair<int, int>> pairs;
        for (const Spring& spring : molecule.springs) {
            CHECK(pairs.insert(std::minmax(spring.a, spring.b)).second);
            CHECK(spring.damping == 0.05 * std::sqrt(spring.stiffness));
        }
        CHECK(std::count_if(molecule.vertices.begin(), molecule.vertices.end(),
                            [](const Vertex& v) { return v.pinned; }) == 2);
    }
    const std::vector<ReportScene> scenes = reportScenes(3);
    CHECK(scenes.size() == 48);
    std::set<std::string> ids;
    for (const ReportScene& one : scenes) {
        CAPTURE(one.id);
        CHECK(ids.insert(one.id).second);
        Scene scene = one.scene;
        scene.solver.kind = SolverKind::bdf2Xpbd;
        CHECK(compile(scene).groups[0].needs.pins == (one.motion == "gusts"));
    }
    // u = (2 + 0.8 z, 0.5 x, 0.3 y) at (x, y, z) = (1, 2, 3) with z up
    const glm::dvec3 fall = reference::fluidVelocity(scenes[0].scene.fields, {1, 3, -2}, 0);
    CHECK(glm::length(fall - glm::dvec3(4.4, 0.6, -0.5)) < 1e-12);
    // u = (4 + 2 sin 6 pi t + 0.5 z, 2 cos 2.6 pi t + 1.2 sin(14.6 pi t + 1) + 0.3 x, sin 10.2 pi t)
    const double t = 0.37, pi = std::acos(-1.0);
    const glm::dvec3 gust = reference::fluidVelocity(scenes[4].scene.fields, {1, 3, -2}, t);
    const glm::dvec3 zUp(4 + 2 * std::sin(6 * pi * t) + 1.5,
                         2 * std::cos(2.6 * pi * t) + 1.2 * std::sin(14.6 * pi * t + 1) + 0.3,
                         std::sin(10.2 * pi * t));
    CHECK(glm::length(gust - glm::dvec3(zUp.x, zUp.z, -zUp.y)) < 1e-12);
}

}  // namespace shoal::measure
