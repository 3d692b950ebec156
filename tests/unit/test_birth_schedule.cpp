#include <algorithm>
#include <cmath>

#include "compile/birth_schedule.h"
#include "simulate/places.h"
#include "support/catch.h"

using namespace shoal;

namespace {

// Moments of birth over frames of the given length.
std::vector<double> moments(const Emitter& emitter, double frame, int frames) {
    BirthClock clock;
    std::vector<double> out;
    for (int f = 0; f < frames; ++f) {
        std::vector<BirthRun> runs;
        addRuns(emitter, 0, 7, f * frame, (f + 1) * frame, clock, runs);
        CHECK(int(runs.size()) <= 1 + int(emitter.bursts.size()));
        for (const BirthRun& run : runs) {
            CHECK(run.ordinal == out.size());
            for (int j = 0; j < run.count; ++j) {
                const double time = run.first + run.interval * (run.random ? 0.5 : j / run.each);
                CHECK(time >= f * frame - 1e-9);
                CHECK(time <= (f + 1) * frame + 1e-9);
                out.push_back(time);
            }
        }
    }
    CHECK(clock.born == out.size());
    return out;
}

}  // namespace

TEST_CASE("births are evenly spaced, whatever the frames are", "[schedule]") {
    Emitter emitter;
    emitter.rate = 37.3;
    emitter.begin = 0.21;
    emitter.end = 4.5;
    for (const double frame : {1.0 / 60, 1.0 / 7, 0.0003}) {
        const std::vector<double> times = moments(emitter, frame, int(5 / frame));
        INFO("frame " << frame);
        REQUIRE(std::abs(double(times.size()) - std::floor(37.3 * 4.29)) <= 1);
        for (size_t k = 0; k < times.size(); ++k)
            CHECK(std::abs(times[k] - (0.21 + double(k + 1) / 37.3)) < 1e-9);
    }
}

TEST_CASE("every moment of a burst falls into one frame", "[schedule]") {
    Emitter emitter;
    emitter.bursts.push_back({0.1, 3, 0});
    emitter.bursts.push_back({0.05, 2, 0.1});
    // 0.1 s and its multiples are the borders of these frames, as far as they can be written
    for (const double frame : {0.1, 0.05, 1.0 / 60, 0.37}) {
        const int frames = int(std::ceil(3 / frame));
        const std::vector<double> times = moments(emitter, frame, frames);
        double repeats = 0;
        while (0.05 + repeats * 0.1 < frames * frame)
            ++repeats;
        INFO("frame " << frame);
        CHECK(times.size() == 3 + 2 * size_t(repeats));
    }
}

TEST_CASE("random births are as many as Poisson's law says", "[schedule]") {
    for (const double rate : {30.0, 900.0, 60000.0}) {
        Emitter emitter;
        emitter.rate = rate;
        emitter.random = true;
        BirthClock clock;
        const int frames = 4000;
        const double mean = rate / 60;
        double sum = 0, squares = 0;
        for (int f = 0; f < frames; ++f) {
            std::vector<BirthRun> runs;
            addRuns(emitter, 0, 11, f / 60.0, (f + 1) / 60.0, clock, runs);
            const double n = runs.empty() ? 0 : runs[0].count;
            sum += n;
            squares += (n - mean) * (n - mean);
        }
        INFO("rate " << rate);
        // mean and variance are the rate's share; 5 standard deviations each: wrong once in 1.7e6
        CHECK(std::abs(sum / frames - mean) < 5 * std::sqrt(mean / frames));
        const double spread = std::sqrt((mean + 2 * mean * mean) / frames);
        CHECK(std::abs(squares / frames - mean) < 5 * spread);
    }
}

TEST_CASE("a rate beyond any capacity stays a number", "[schedule]") {
    Emitter emitter;
    emitter.rate = 1e15;
    BirthClock clock;
    std::vector<BirthRun> runs;
    for (int f = 0; f < 3; ++f)
        addRuns(emitter, 0, 1, f, f + 1, clock, runs);
    for (const BirthRun& run : runs)
        CHECK(run.count == mostInRun);
    CHECK(clock.due >= 0);
    CHECK(clock.due < 1);
}

TEST_CASE("the heap hands out the smallest free place, the stack the last freed", "[places]") {
    for (const Allocator allocator : {Allocator::heap, Allocator::stack}) {
        Places places(allocator, 10);
        uint32_t place = 99;
        for (uint32_t i = 0; i < 10; ++i) {
            REQUIRE(places.take(1 + i % 3, place));
            CHECK(place == i);
        }
        CHECK_FALSE(places.take(5, place));
        CHECK(places.mark() == 10);
        places.freeUntil(1);  // 0, 3, 6, 9
        CHECK(places.taken() == 6);
        CHECK(places.mark() == 9);
        REQUIRE(places.take(5, place));
        CHECK(place == (allocator == Allocator::heap ? 0u : 9u));
        Places copy(allocator, 10);
        copy.restore(places.ends(), places.stack(), 1);
        for (int i = 0; i < 3; ++i) {
            uint32_t a = 98, b = 99;
            REQUIRE(places.take(6, a));
            REQUIRE(copy.take(6, b));
            CHECK(a == b);
        }
        CHECK(copy.taken() == 10);
    }
}
