// The numbers of a frame that a simulation hands to its shaders, against their closed forms.
#include <cmath>

#include "compile/clocks.h"
#include "simulate/step.h"
#include "support/catch.h"

namespace shoal {

TEST_CASE("drag over a step is exact from no drag at all to the heaviest", "[step]") {
    GroupPlan group;
    group.solver = SolverKind::rk4;
    const double h = 1 / 240.0;
    for (const double x : {0.0, 1e-8, 1e-5, 4e-4, 0.99e-3, 1.01e-3, 0.02, 0.5, 3.0, 60.0}) {
        group.drag = {x / h, x / h};
        const DragCoefficients found = dragCoefficients(group, Parameters{}, h);
        // as series, of which a term is below 1e-9 of the sum or the closed form holds
        const double phi =
            x < 0.1 ? 1 - x / 2 + x * x / 6 - x * x * x / 24 + x * x * x * x / 120 : (1 - std::exp(-x)) / x;
        const double bend =
            x < 0.1 ? 0.5 - x / 6 + x * x / 24 - x * x * x / 120 + x * x * x * x / 720 : (1 - phi) / x;
        CAPTURE(x);
        CHECK(double(found.decay.x) == Approx(x * phi).epsilon(2e-7).margin(1e-30));
        CHECK(double(found.phi.x) == Approx(h * phi).epsilon(2e-7));
        CHECK(double(found.bend.x) == Approx(h * h * bend).epsilon(2e-7));
    }
}

TEST_CASE("the pieces of frames follow one another and draw different lots; only a frame's first starts anew",
          "[step]") {
    Frame frame;
    frame.h = 1 / 240.0;
    frame.end = 4 / 240.0;
    frame.parameters.substeps = 4;
    frame.restarts = true;
    double time = 0;
    int number = -1;
    for (int f = 0; f < 2; ++f) {
        for (int i = 0; i < 3; ++i) {
            const Frame piece = pieceOf(frame, i, 3);
            CHECK(piece.time == time);
            CHECK(piece.number > number);
            CHECK(piece.restarts == (i == 0));
            CHECK(piece.parameters.frameTime == Approx(piece.end - piece.time));
            time = piece.end, number = piece.number;
        }
        frame.time = frame.end;
        frame.end += 4 * frame.h;
        ++frame.number;
    }
    CHECK(time == frame.time);
}

// Frames at 1, 2 and 4 s, over and over every 4 s.
TEST_CASE("a sequence that repeats is where it was a period ago, before its first frame as well", "[step]") {
    ClockSlot clock;
    clock.kind = FieldClock::Kind::frames;
    clock.times = {1, 2, 4};
    clock.period = 4;
    std::vector<glm::vec4> parameters(1);
    for (const double period : {-8.0, -4.0, 0.0, 4.0, 400.0}) {
        const glm::vec2 expected[] = {{0, 0}, {0, 0.5f}, {1, 0}, {1, 1}, {2, 0.5f}};
        const double times[] = {1, 1.5, 2, 3, 4.5};
        for (int i = 0; i < 5; ++i) {
            setClocks(parameters, {clock}, times[i] + period);
            CAPTURE(period, times[i]);
            CHECK(glm::vec2(parameters[0]) == expected[i]);
        }
    }
}

}  // namespace shoal
