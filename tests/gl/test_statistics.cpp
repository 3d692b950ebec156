// Statistics of methods against a reference's, on scenes whose statistics are known.
#include <cmath>

#include "gl/gl_test.h"
#include "measure/statistics.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

namespace shoal {

using namespace test;
using namespace measure;

namespace {

StatisticsReport measured(const std::string& text, const StatisticsOptions& options, uint64_t seed = 1) {
    const Scratch scratch;
    scratch.write("statistics.scene.json", text);
    Scene scene = readScene(scratch.path("statistics.scene.json"));
    scene.seed = seed;
    return measureStatistics(scene, options, {.context = &testContext(), .cores = 2, .path = testPath()});
}

// Points of 1 g in a box, with more keys of the group and of the scene.
std::string points(int count, const std::string& ofGroup, const std::string& ofScene) {
    return concat(R"({"format": "shoal-scene-1", "groups": [{"name": "points", "particle": {"mass": 0.001, )",
                  R"("size": 0.01}, "count": )", count,
                  R"(, "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}})", ofGroup,
                  "}]", ofScene, "}");
}

// Quads at random in gusts; of 45 Hz, which a substep of a frame does not resolve.
const char* const gusts = R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0], "solver": {"substeps": 8},
  "fields": [{"type": "gust", "direction": [1, 0, 0.3], "speed": 3, "length": 2}],
  "groups": [{"molecule": "quad", "count": 30, "drag": {"normal": 6, "tangent": 0.6}, "spin": [9, 4, 2],
    "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}, "turn": "any"}}]})";

const Difference& find(const std::vector<Difference>& differences, const std::string& quantity,
                       const std::string& statistic = "mean") {
    for (const Difference& difference : differences)
        if (difference.quantity == quantity && difference.statistic == statistic) return difference;
    FAIL("no " << statistic << " of " << quantity);
    return differences.front();
}

int differing(const std::vector<Difference>& differences) {
    int out = 0;
    for (const Difference& difference : differences)
        out += difference.verdict == Verdict::differs;
    return out;
}

}  // namespace

TEST_CASE("points that fall from random heights have the statistics of the formula", "[statistics]") {
    constexpr int seeds = 12;
    const StatisticsReport report =
        measured(points(60, "", R"(, "gravity": [0, -9.81, 0])"),
                 {.seeds = seeds, .duration = 0.5, .solvers = {SolverKind::leapfrog}});
    CHECK(report.reference.isDouble);
    CHECK(report.reference.settled);
    CHECK(report.displaced == 0);
    CHECK(report.seeds == seeds);
    const std::vector<Difference>& found = report.methods.at(0).differences;
    const double fallen = 9.81 * 0.25 / 2;
    for (const auto& [statistic, height] :
         {std::pair{"mean", 0.5}, {"5 %", 0.05}, {"50 %", 0.5}, {"95 %", 0.95}}) {
        const Difference& difference = find(found, "height", statistic);
        CAPTURE(statistic, difference.reference.mean, difference.reference.half);
        // three standard errors, and how far a quantile of 60 numbers is from that of all
        CHECK(std::abs(difference.reference.mean - (height - fallen)) <
              1.4 * difference.reference.half + 0.01);
        CHECK(std::abs(difference.difference.mean) < 1e-5);  // leapfrog falls exactly, in float
    }
    CHECK(*find(found, "height").scale == Approx(std::sqrt(1.0 / 12)).epsilon(0.05));
    CHECK(find(found, "speed").value.mean == Approx(9.81 * 0.5));
    CHECK(find(found, "polarisation").value.mean == Approx(1));
    const Difference& energy = find(found, "energy");
    CHECK(energy.value.mean == Approx(9.81 * (find(found, "height").value.mean + fallen)).epsilon(1e-4));
    CHECK(find(found, "spread").reference.mean > 0.7);
    // all that differs are roundings
    CHECK(report.methods[0].within < 1e-3);
}

TEST_CASE("a method differs from itself by nothing, and a bad one is told", "[statistics][fused]") {
    const StatisticsReport report = measured(gusts, {.seeds = 12,
                                                     .molecules = 16,
                                                     .solvers = {SolverKind::leapfrog, SolverKind::xpbd},
                                                     .substeps = {8, 1}});
    REQUIRE(report.methods.size() == 4);
    CHECK(report.groups.at(0).molecules == 16);
    CHECK(report.reference.settled);
    const StatisticsMethod &good = report.methods[0], &bad = report.methods[3];
    CHECK(bad.solver == "xpbd");
    CHECK(bad.substeps == 1);
    for (const Difference& difference : compare(good.ensemble, good.ensemble, report.seeds)) {
        CHECK(difference.difference.mean == 0);
        CHECK(difference.difference.half == 0);
        CHECK(difference.verdict == Verdict::none);
    }
    REQUIRE(good.outcome == Outcome::measured);
    CHECK(*good.differences.at(*good.worst).relative() < 0.05);
    CHECK(*bad.differences.at(*bad.worst).relative() > 0.1);
    CHECK(differing(bad.differences) > 3);
    CHECK(find(bad.differences, "energy").difference.mean < 0);  // it damps
}

TEST_CASE("seeds that two ensembles do not share tell the same of points in eddies", "[statistics]") {
    const std::string eddies =
        points(40, R"(, "drag": 3)",
               R"(, "fields": [{"type": "curlNoise", "speed": 1, "length": 0.5, "period": 1}])");
    const StatisticsOptions options{.seeds = 12, .molecules = 40};
    const StatisticsReport first = measured(eddies, options), second = measured(eddies, options, 1000);
    const std::vector<Difference> apart =
        compare(first.methods.at(0).ensemble, second.methods.at(0).ensemble, 12);
    REQUIRE(apart.size() == 21);
    CHECK(differing(apart) == 0);
    int beyond = 0;
    for (const Difference& difference : apart)
        beyond += difference.verdict != Verdict::none;
    CHECK(beyond <= 3);  // one is expected, and statistics of a quantity go together
    CHECK(differing(first.methods[0].differences) == 0);
}

TEST_CASE("what touches has its reference on the device, and places from a grid are displaced",
          "[statistics][fused]") {
    const StatisticsReport report = measured(
        R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0], "solver": {"method": "leapfrog", "substeps": 2},
  "colliders": [{"type": "plane"}],
  "groups": [{"name": "heap", "particle": {"mass": 0.001, "size": 0.1}, "contact": {"radius": 0.05},
    "place": {"on": "grid", "origin": [0, 0.1, 0], "spacing": [0.12, 0.15, 0.12], "cells": [3, 3, 3]}}]})",
        {.seeds = 3, .duration = 0.5});
    CHECK_FALSE(report.reference.isDouble);
    CHECK(report.reference.solver == "leapfrog");
    CHECK(report.reference.substeps == 16);
    CHECK(report.reference.why == "contact between molecules");
    CHECK(report.displaced == 1e-6);
    // starts that are nearly alike leave nothing to chance, and the heap settles by its step
    CHECK_FALSE(report.reference.settled);
    CHECK_THAT(report.notes.back(), Catch::Contains("the reference has not converged"));
    CHECK(find(report.methods.at(0).differences, "spread").reference.half > 0);
    const std::vector<Difference>& found = report.methods.at(0).differences;
    const double packing = find(found, "packing").reference.mean;
    CHECK(packing > 0.02);
    CHECK(packing < 0.75);
    CHECK_FALSE(find(found, "angle of repose", "value").scale);
    CHECK(find(found, "nearest neighbour", "5 %").reference.mean > 0.09);
}

TEST_CASE("runs take other places of a list that is long enough, and else are displaced", "[statistics]") {
    std::string items;
    for (int i = 0; i < 6; ++i)
        items += concat(i > 0 ? ", " : "", R"({"position": [0, )", i, ", 0]}");
    const std::string scene =
        concat(R"({"format": "shoal-scene-1", "groups": [{"particle": {"mass": 0.001, "size": 0.01}, )",
               R"("velocity": [1, 0, 0], "place": {"on": "list", "items": [)", items, "]}}]}");
    const StatisticsReport turns = measured(scene, {.seeds = 3, .molecules = 2});
    CHECK(turns.displaced == 0);
    CHECK_THAT(turns.notes.at(0), Catch::Contains("next places of a list"));
    // means of 0 and 1, of 2 and 3, of 4 and 5
    const Difference& height = find(turns.methods.at(0).differences, "height");
    CHECK(height.reference.mean == Approx(2.5));
    CHECK(height.reference.half == Approx(4.30265272991 * 2 / std::sqrt(3)));
    CHECK(height.difference.half < 1e-6);

    const StatisticsReport shifted = measured(scene, {.seeds = 3, .molecules = 4});
    CHECK(shifted.displaced == 0.01);
    const Estimate& mean = find(shifted.methods.at(0).differences, "height").reference;
    CHECK(mean.mean == Approx(1.5).margin(0.01));
    CHECK(mean.half > 1e-4);
    CHECK(mean.half < 0.05);
}

TEST_CASE("what has no statistics is refused", "[statistics]") {
    const AccuracyDevice device{.context = &testContext()};
    CHECK_THAT(messageOf([&] { measureStatistics(Scene{}, {}, device); }),
               Catch::Contains("the scene has no molecules to measure"));
    CHECK_THAT(
        messageOf([&] { measured(gusts, {.seeds = 2, .solvers = {SolverKind::euler}, .substeps = {1}}); }),
        Catch::Contains("no method can run this scene: euler is stable"));
}

}  // namespace shoal
