// The rate of frames that the windows keep: how pictures become cheaper, and full again.
#include <algorithm>

#include "support/catch.h"
#include "window/frame_rate.h"

using namespace shoal;
using namespace shoal::window;

namespace {

// Frames of a machine on which a full picture takes `full` s and all else `other`; returns the seconds of the
// last.
double run(FrameRate& rate, double full, double other, int frames) {
    double seconds = 0;
    for (int i = 0; i < frames; ++i)
        rate.took(seconds = other + full * rate.level().cost, full * rate.level().cost);
    return seconds;
}

bool isFull(const FrameRate& rate) {
    return rate.level().scale == 1 && rate.level().quality == Quality{};
}

}  // namespace

TEST_CASE("a rate that full pictures keep leaves them full", "[window]") {
    FrameRate rate;
    CHECK(run(rate, 0.006, 0.001, 500) == Approx(0.007));  // a monitor of 144 Hz
    CHECK(isFull(rate));
    run(rate, 0.04, 0.005, 500);
    CHECK(isFull(rate));
    CHECK(told(rate.level()).empty());
}

TEST_CASE("a slow picture keeps the rate by size, samples, shadows and occlusion, in that order",
          "[window]") {
    for (const double full : {0.06, 0.1, 0.2, 0.3}) {
        CAPTURE(full);
        FrameRate rate;
        CHECK(run(rate, full, 0.01, 40) <= 1.05 / FrameRate::wanted);
        CHECK_FALSE(rate.missed());
        CHECK_FALSE(isFull(rate));
    }
    for (size_t i = 1; i < pictureLevels.size(); ++i) {
        const PictureLevel &more = pictureLevels[i - 1], &less = pictureLevels[i];
        CHECK(less.cost < more.cost);
        CHECK(less.scale <= more.scale);
        CHECK(less.quality.samples <= more.quality.samples);
        CHECK(less.quality.shadows <= more.quality.shadows);
        CHECK(less.quality.occlusion <= more.quality.occlusion);
    }
}

TEST_CASE("a rate that the least picture keeps is kept, however much of the frame is not the picture's",
          "[window]") {
    for (const double other : {0.02, 0.03, 0.04, 0.044}) {
        for (const double full : {0.01, 0.02, 0.03, 0.05}) {
            CAPTURE(other, full);
            FrameRate rate;
            CHECK(run(rate, full, other, 300) <= 1.05 / FrameRate::wanted);
            CHECK_FALSE(rate.missed());
        }
    }
}

TEST_CASE("a wait for the monitor is not taken for the picture's time", "[window]") {
    for (const double hertz : {30, 60, 144}) {
        CAPTURE(hertz);
        FrameRate rate;
        run(rate, 0.3, 0.01, 100);
        double seconds = 0;
        for (int i = 0; i < 2000; ++i) {
            const double drawing = 0.004 * rate.level().cost;
            const double told = rate.measures(seconds) ? drawing : seconds;
            seconds = std::max(1 / hertz, 0.01 + drawing);
            rate.took(seconds, told);
        }
        CHECK(isFull(rate));
        CHECK_FALSE(rate.missed());
    }
}

TEST_CASE("what is quick again becomes full again, and what was too slow is not tried every second",
          "[window]") {
    FrameRate rate;
    run(rate, 0.3, 0.01, 100);
    run(rate, 0.03, 0.005, 2000);
    CHECK(isFull(rate));
    run(rate, 0.3, 0.01, 100);
    int changes = 0;
    for (int i = 0; i < 600; ++i) {
        const double before = rate.level().cost;
        run(rate, 0.3, 0.01, 1);
        changes += rate.level().cost != before;
    }
    CHECK(changes <= 4);
}

TEST_CASE("a rate that cannot be kept is known, and that the user does not want one", "[window]") {
    FrameRate rate;
    run(rate, 2, 0.01, 60);
    CHECK(rate.missed());
    CHECK(rate.level().cost == pictureLevels.back().cost);
    CHECK_FALSE(told(rate.level()).empty());
    rate.keeps = false;
    CHECK(isFull(rate));
    CHECK_FALSE(rate.missed());
    rate.keeps = true;
    run(rate, 0.01, 0.01, 40);
    CHECK_FALSE(rate.missed());
    // where all else is slow, pictures do not lose what would not be seen in the rate
    FrameRate beside;
    CHECK(run(beside, 0.3, 0.4, 100) > 0.5);
    CHECK(beside.missed());
    CHECK_THAT(beside.whyMissed(), Catch::Contains("all but the picture takes 400 ms"));
    CHECK(beside.level().scale >= 0.7);
    // a single slow frame, such as one in which a program is made, changes nothing
    FrameRate other;
    run(other, 0.02, 0.01, 50);
    run(other, 3, 0.01, 1);
    run(other, 0.02, 0.01, 50);
    CHECK(isFull(other));
}
