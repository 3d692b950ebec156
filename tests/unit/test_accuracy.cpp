// The pure parts of `shoal measure`: the front, the ladder of steps, what is claimed and when time ends.
#include <algorithm>
#include <cmath>

#include "measure/accuracy.h"
#include "measure/calibrate.h"
#include "measure/method_runner.h"
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
    CHECK(SampleError{.rms = 5e-5, .worst = 1e-4, .molecules = 300}.holds(1e-3));
    CHECK_FALSE(SampleError{}.holds(1e-3));
    // 12 of 400 end elsewhere
    CHECK_FALSE(SampleError{.rms = 3.9e-2, .worst = 0.36, .molecules = 300, .above = 9}.holds(1e-3));
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 2e-3, .molecules = 300, .above = 9}.holds(1e-3));
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 1.2e-2, .molecules = 300, .above = 1}.holds(1e-3));
    CHECK(SampleError{.rms = 9e-4, .worst = 2e-3, .molecules = 300, .above = 3}.holds(1e-3));
    // what is not known counts as above
    CHECK(SampleError{.rms = 9e-4, .worst = 2e-3, .molecules = 300, .above = 1, .unknown = 2}.holds(1e-3));
    CHECK_FALSE(SampleError{.rms = 2.5e-5, .worst = 8e-5, .molecules = 900, .unknown = 882}.holds(1e-4));
    CHECK_FALSE(
        SampleError{.rms = 9e-4, .worst = 2e-3, .molecules = 300, .above = 2, .unknown = 2}.holds(1e-3));
    // of few molecules none may be above
    CHECK_FALSE(SampleError{.rms = 9e-4, .worst = 2e-3, .molecules = 20, .above = 1}.holds(1e-3));
}

TEST_CASE("the ladder of steps", "[accuracy]") {
    const std::vector<Step> coarse = stepLadder(16);
    REQUIRE(coarse.size() == 14);
    for (size_t i = 0; i < coarse.size(); ++i) {
        CHECK(coarse[i].perFrame() == 1 << i);
        CHECK(coarse[i].substeps <= maxSubsteps);
        CHECK((coarse[i].split == 1) == (i < 10));
    }
    CHECK(stepLadder(1).back() == Step{512, 1});
}

TEST_CASE("a limit of time is left to later stages where an early one needs less", "[accuracy]") {
    double clock = 100;
    const TimeLimit limit(10, [&] { return clock; });
    CHECK(limit.left() == 10);
    CHECK(limit.left(0.2) == 2);
    clock = 101;
    CHECK(limit.left(0.2) == 1);
    CHECK(limit.left(0.5) == 4);
    CHECK(limit.part(0.5).left() == 4);
    CHECK(*limit.part(0.5).seconds() == 5);
    CHECK_FALSE(limit.over(0.2));
    clock = 103;
    CHECK(limit.over(0.2));
    CHECK(limit.left(0.2) == 0);
    CHECK_FALSE(limit.over());
    TimeLimit longer = limit;
    longer.leaveOut(3);
    CHECK(longer.left() == 10);
    CHECK(longer.left(0.2) == 2);
    clock = 1e9;
    CHECK(limit.over());
    const TimeLimit none({}, [&] { return clock; });
    clock = 1e18;
    CHECK_FALSE(none.over(0.01));
    CHECK(std::isinf(none.part(0.5).left()));
}

TEST_CASE("times end when their seconds are over, and say by the first round what has none", "[accuracy]") {
    // a clock of its own: each visit takes `slow` times what was expected of it
    const std::vector<double> cost = {0.01, 0.02, 0.1, 0.5, 1, 4};
    CHECK(thoseThatFit(cost, 0.2) == std::vector<bool>{true, true, true, false, false, false});
    CHECK(thoseThatFit({4, 0.5, 1}, 0) == std::vector<bool>{false, true, false});
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

}  // namespace shoal::measure
