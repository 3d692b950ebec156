// The quantities that scenes are looked at for where paths part, on arrangements whose numbers are known.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "measure/confidence.h"
#include "measure/ensemble.h"
#include "measure/point_tree.h"
#include "measure/quantities.h"
#include "support/catch.h"

namespace shoal::measure {

namespace {

Centers centersOf(std::vector<glm::dvec3> positions) {
    Centers out;
    out.velocities.resize(positions.size());
    out.positions = std::move(positions);
    return out;
}

// A cube of n^3 places, `spacing` apart.
std::vector<glm::dvec3> lattice(int n, double spacing) {
    std::vector<glm::dvec3> out;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z)
                out.push_back(spacing * glm::dvec3(x, y, z));
    return out;
}

double meanOf(const std::vector<double>& values) {
    return estimateOf(values).mean;
}

// Sum of 24 uniform numbers less 12: normal as far as intervals of a mean can tell, variance 2.
double normal(Random& random) {
    double out = -12;
    for (int i = 0; i < 24; ++i)
        out += random.uniform();
    return out;
}

}  // namespace

TEST_CASE("Student's t has the limits of the tables", "[statistics]") {
    const std::tuple<double, int, double> rows[] = {{0.95, 1, 12.7062047364},  {0.95, 2, 4.30265272991},
                                                    {0.95, 3, 3.18244630528},  {0.95, 10, 2.22813885199},
                                                    {0.95, 31, 2.03951344640}, {0.99, 7, 3.49948329735},
                                                    {0.9, 120, 1.65765089935}};
    for (const auto& [share, freedom, limit] : rows) {
        CAPTURE(share, freedom);
        CHECK(studentLimit(share, freedom) == Approx(limit).epsilon(1e-8));
        CHECK(studentShare(limit, freedom) == Approx(share).epsilon(1e-9));
    }
    CHECK(studentShare(0, 5) == 0);
}

TEST_CASE("means and quantiles", "[statistics]") {
    const Estimate estimate = estimateOf({1, 2, 3, 4});
    CHECK(estimate.mean == 2.5);
    CHECK(estimate.half == Approx(3.18244630528 * std::sqrt(5.0 / 3 / 4)));
    CHECK(std::isinf(estimateOf({7}).half));
    CHECK_FALSE(estimateOf({7}).excludesZero());
    CHECK(estimateOf({-1, -1, -1.001}).excludesZero());
    CHECK(quantileOf({4, 1, 3, 2}, 0.5) == 2.5);
    CHECK(quantileOf({4, 1, 3, 2, 5}, 0.05) == Approx(1.2));
    CHECK(quantileOf({4, 1, 3, 2, 5}, 1) == 5);
    CHECK(quantileOf({7}, 0.95) == 7);
}

TEST_CASE("the nearest of many points is found as by brute force", "[statistics]") {
    Random random(1);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 400; ++i)  // clusters, a plane, and equal points
        points.push_back(i % 3 == 0    ? glm::dvec3(random.uniform(), random.uniform(), 5)
                         : i % 50 == 1 ? points.back()
                                       : 0.01 * random.direction() + glm::dvec3(i % 7, 0, 0));
    const PointTree tree(points);
    for (size_t i = 0; i < points.size(); ++i) {
        double nearest = 1e30;
        size_t within = 0, visited = 0;
        for (size_t j = 0; j < points.size(); ++j) {
            const double distance = glm::length(points[i] - points[j]);
            if (j != i) nearest = std::min(nearest, distance);
            within += distance <= 0.015;
        }
        CHECK(tree.nearestDistance(i) == Approx(nearest).margin(1e-15));
        tree.within(points[i], 0.015, [&](size_t) { ++visited; });
        CHECK(visited == within);
    }
    CHECK(std::isinf(PointTree({glm::dvec3(1)}).nearestDistance(0)));
}

TEST_CASE("a lattice has its spacing and its packing", "[statistics]") {
    const Centers centers = centersOf(lattice(9, 0.1));
    for (const double distance : nearestDistances(centers))
        CHECK(distance == Approx(0.1));
    const Centers middle = centersOf({glm::dvec3(0.4)});
    const std::vector<double> radii(centers.size(), 0.05);
    // pi/6 in a cubic lattice, but for what the ball's surface cuts
    CHECK(packings(middle, centers.positions, radii, 0.4).front() ==
          Approx(std::numbers::pi / 6).epsilon(0.02));
    CHECK(packings(middle, {glm::dvec3(0.4)}, {0.05}, 0.1).front() == Approx(0.125));
}

TEST_CASE("what two balls have in common is what random places find in both", "[statistics]") {
    CHECK(commonVolume(3, 1, 2) == 0);
    CHECK(commonVolume(0.5, 1, 2) == Approx(4 * std::numbers::pi / 3));
    CHECK(commonVolume(0, 2, 1) == Approx(4 * std::numbers::pi / 3));
    Random random(3);
    int both = 0;
    constexpr int places = 40000;
    for (int i = 0; i < places; ++i) {
        const glm::dvec3 place(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        both += glm::length(place) < 1 && glm::length(place - glm::dvec3(0.9, 0, 0)) < 0.7;
    }
    CHECK(commonVolume(0.9, 1, 0.7) == Approx(8.0 * both / places).epsilon(0.03));
}

TEST_CASE("an even cone has its slope for the angle of repose, whichever way is up", "[statistics]") {
    for (const double degrees : {10.0, 25.0, 40.0}) {
        const double slope = degrees * std::numbers::pi / 180, radius = 0.3,
                     height = radius * std::tan(slope);
        Random random(2);
        std::vector<glm::dvec3> upright, sideways;
        while (upright.size() < 40000) {
            const glm::dvec3 p(random.uniform(-radius, radius), random.uniform(0, height),
                               random.uniform(-radius, radius));
            if (std::hypot(p.x, p.z) > radius * (1 - p.y / height)) continue;
            upright.push_back(p + glm::dvec3(5, 7, -2));
            sideways.push_back(glm::dvec3(p.y, p.z, p.x));
        }
        CHECK(reposeAngle(centersOf(upright), {0, 1, 0}) == Approx(slope).epsilon(0.01));
        CHECK(reposeAngle(centersOf(sideways), {1, 0, 0}) == Approx(slope).epsilon(0.01));
    }
    CHECK(reposeAngle(centersOf(lattice(4, 1)), {0, 1, 0}) > 1);  // a block is steep
}

TEST_CASE("what goes one way is polarised, and what rests or goes all ways is not", "[statistics]") {
    Random random(4);
    Centers centers;
    centers.positions.resize(4000);
    centers.velocities.assign(4000, glm::dvec3(0, 0, 3));
    CHECK(meanOf(alignments(centers, 0.1)) == Approx(1));
    std::fill_n(centers.velocities.begin(), 2000, glm::dvec3(0, 0, 0.05));
    CHECK(meanOf(alignments(centers, 0.1)) == Approx(0.5));
    for (glm::dvec3& velocity : centers.velocities)
        velocity = random.uniform(1, 2) * random.direction();
    CHECK(meanOf(alignments(centers, 0.1)) < 0.03);
    glm::dvec3 sum(0);
    for (const glm::dvec3& velocity : centers.velocities)
        sum += glm::normalize(velocity) / 4000.0;
    CHECK(meanOf(alignments(centers, 0.1)) == Approx(glm::length(sum)));
    CHECK(meanOf(alignments(centers, 9)) == 0);
}

TEST_CASE("centres are weighed by mass, and the dead are left out", "[statistics]") {
    Snapshot snapshot;
    snapshot.count = 3;
    snapshot.vertexCount = 2;
    snapshot.positions = {{0, 0, 0}, {4, 0, 0}, {9, 9, 9}, {9, 9, 9}, {0, 2, 0}, {0, 2, 4}};
    snapshot.velocities = {{0, 0, 0}, {0, 8, 0}, {9, 9, 9}, {9, 9, 9}, {1, 0, 0}, {1, 0, 0}};
    snapshot.alive = {true, false, true};
    const Centers centers = measure::centersOf(snapshot, {1, 3});
    CHECK(centers.molecules == std::vector<int>{0, 2});
    CHECK(centers.positions[0] == glm::dvec3(3, 0, 0));
    CHECK(speeds(centers) == std::vector<double>{6, 1});
    CHECK(heights(centers, {0, 1, 0}) == std::vector<double>{0, 2});
    const double half = glm::length(glm::dvec3(3, -2, -3)) / 2;
    CHECK(spreads(centers)[0] == Approx(half));
    CHECK(spreads(centers)[1] == Approx(half));
}

TEST_CASE("intervals of two ensembles of one kind hold 0 in 95 of 100, and verdicts are rarer",
          "[statistics]") {
    // heights of 20 molecules in each of 30 runs, from one distribution
    Random random(5);
    const auto ensemble = [&](double shift) {
        Ensemble out;
        for (int run = 0; run < 30; ++run) {
            std::vector<double> values;
            for (int m = 0; m < 20; ++m)
                values.push_back(normal(random) + shift);
            out.add("points", {{"height", "m", values, 0.01}});
        }
        return out;
    };
    constexpr int trials = 250;
    int beyond[4] = {}, verdicts = 0, seen = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Ensemble reference = ensemble(0);
        const std::vector<Difference> differences = compare(reference, ensemble(0), 30);
        REQUIRE(differences.size() == 4);
        bool differs = false;
        for (size_t i = 0; i < 4; ++i) {
            beyond[i] += differences[i].verdict != Verdict::none;
            differs = differs || differences[i].verdict == Verdict::differs;
        }
        CHECK(*differences[0].scale == Approx(std::sqrt(2)).epsilon(0.12));
        verdicts += differs;
        seen += compare(reference, ensemble(0.5), 30)[0].verdict == Verdict::differs;
    }
    for (const int count : beyond)
        CHECK(std::abs(count - 0.05 * trials) < 3 * std::sqrt(0.05 * 0.95 * trials));
    CHECK(verdicts < 0.05 * trials + 3 * std::sqrt(0.05 * 0.95 * trials));
    CHECK(seen > 0.95 * trials);  // 0.35 of the standard deviation, at an interval of 0.08
}

TEST_CASE("an ensemble leaves out what a run lacks, and a shape has no scale", "[statistics]") {
    Ensemble reference, method;
    for (int run = 0; run < 3; ++run) {
        std::vector<Quantity> quantities = {{"height", "m", {1.0 + run, 2.0 + run}, 0.01},
                                            {"slope", "", {0.5 * run}, 0, Quantity::Summary::value}};
        if (run > 0) quantities.push_back({"spread", "m", {1, 2}, 0.01});
        reference.add("a", quantities);
        for (double& value : quantities[0].values)
            value += 1 + 0.5 * run;
        method.add("a", quantities);
    }
    const std::vector<Difference> differences = compare(reference, method, 3);
    REQUIRE(differences.size() == 5);
    CHECK(differences[0].difference.mean == Approx(1.5));
    // pairs have their seed in common: what seeds do to both cancels
    CHECK(differences[0].difference.half == Approx(4.30265272991 * 0.5 / std::sqrt(3)));
    CHECK(differences[0].reference.half == Approx(4.30265272991 / std::sqrt(3)));
    CHECK(differences[0].verdict == Verdict::perhaps);
    CHECK(*differences[0].scale == Approx(std::sqrt(5.5 / 5)));
    CHECK(differences[4].statistic == "value");
    CHECK_FALSE(differences[4].scale);
    CHECK(differences[4].verdict == Verdict::none);
    CHECK(differences[*worstOf(differences)].quantity == "height");
    CHECK(withinOf(differences) > *differences[0].relative());
}

}  // namespace shoal::measure
