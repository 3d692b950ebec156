// How long is left, by the steps before.
#include "run/progress.h"
#include "support/catch.h"

using namespace shoal;

TEST_CASE("the time that is left follows from the last steps alone", "[progress]") {
    TimeLeft left;
    CHECK(left.seconds(100) == 0);
    left.reach(1, 60);  // in which drivers compiled
    CHECK(left.seconds(100) == 0);
    left.reach(2, 61);
    CHECK(left.seconds(100) == Approx(98));
    for (int done = 3; done <= 40; ++done)
        left.reach(done, 61 + 10 * (done - 2));
    CHECK(left.seconds(100) == Approx(600));
    // quicker from here on, and several steps at once
    double time = 61 + 380;
    for (int done = 42; done <= 60; done += 2)
        left.reach(done, time += 1);
    CHECK(left.seconds(100) == Approx(20));
    left.reach(100, time + 1);
    CHECK(left.seconds(100) == 0);
}
