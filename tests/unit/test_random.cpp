#include "support/catch.h"

#include <set>

#include "core/random.h"

using namespace shoal;

TEST_CASE("PCG32 gives the published sequence", "[random]") {
    // The demo program of pcg-c-basic, seed 42 and stream 54.
    Random random(42, 54);
    for (const uint32_t expected :
         {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
        CHECK(random.next() == expected);
}

TEST_CASE("uniform numbers have the right moments and stay below 1", "[random]") {
    Random random(7);
    double sum = 0, squares = 0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double u = random.uniform();
        REQUIRE((u >= 0 && u < 1));
        sum += u;
        squares += u * u;
    }
    CHECK(sum / count == Approx(0.5).margin(0.005));  // five standard deviations
    CHECK(squares / count == Approx(1.0 / 3).margin(0.005));
    for (int i = 0; i < 1000; ++i) {
        const double u = random.uniform(-3, -2);
        REQUIRE((u >= -3 && u < -2));
    }
}

TEST_CASE("directions are of unit length and cover the sphere evenly", "[random]") {
    Random random(3);
    glm::dvec3 sum(0), squares(0);
    constexpr int count = 30000;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 d = random.direction();
        REQUIRE(glm::length(d) == Approx(1).epsilon(1e-12));
        sum += d;
        squares += d * d;
    }
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(sum[axis] / count == Approx(0).margin(0.02));
        CHECK(squares[axis] / count == Approx(1.0 / 3).margin(0.01));
    }
}

TEST_CASE("seeds and streams differ, and a seed repeats", "[random]") {
    CHECK(Random(1).next() == Random(1).next());
    CHECK(Random(1).next() != Random(2).next());
    CHECK(Random(1, 0).next() != Random(1, 1).next());
}

TEST_CASE("hashes differ in every argument", "[random]") {
    std::set<uint32_t> seen;
    for (uint32_t seed = 0; seed < 100; ++seed)
        for (uint32_t counter = 0; counter < 100; ++counter)
            seen.insert(hash(seed, counter));
    CHECK(seen.size() > 9980);  // of 10,000; chance repeats among 2^32 values are rare
    CHECK(hash(1, 2, 3) != hash(1, 3, 2));
    CHECK(hash(1, 2, 3, 4) != hash(1, 2, 3, 5));
}
