// The window, seen: under a display (tests/CMakeLists.txt starts one) a screenshot shows scene and panel.
// Hidden from plain runs of shoal-cli, which have no display.
#include "cli/shoal_command.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

// Mean brightness, 0 to 255, of a rectangle of the picture.
static double brightness(const Image& image, int left, int top, int width, int height) {
    double sum = 0;
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x)
            for (int c = 0; c < 3; ++c)
                sum += image.pixels[size_t((y * image.width + x) * image.channels + c)];
    return sum / (3.0 * width * height);
}

TEST_CASE("a window shows the scene and the panel", "[.window]") {
    const Scratch scratch;
    const std::string file = scratch.path("window.png");
    const Outcome outcome = runShoal({"run", helloScene(), "--context", "window", "--size", "800x600",
                                      "--frames", "3", "--screenshot", file});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const Image image = readPng(file);
    CHECK(image.width == 800);
    CHECK(image.height == 600);
    CHECK(brightness(image, 200, 320, 100, 20) < 90);  // the panel's dark background
    CHECK(brightness(image, 500, 20, 250, 60) > 110);  // the sky beside it
    CHECK(brightness(image, 20, 14, 90, 10) > 25);     // its title is written on it
    CHECK(brightness(image, 20, 14, 90, 10) < 160);
}

TEST_CASE("a scene that does not load opens no window", "[.window]") {
    refusal({"run", "missing.scene.json", "--context", "window"}, "no such file");
}
