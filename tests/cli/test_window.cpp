// The window, seen: under a display (tests/CMakeLists.txt starts one) a screenshot shows scene and panel.
// Hidden from plain runs of shoal-cli, which have no display.
#include <chrono>
#include <csignal>

#include "cli/shoal_command.h"
#include "cli/window_user.h"
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
    const Outcome outcome = runShoal({"run", squaresScene(), "--context", "window", "--size", "800x600",
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

TEST_CASE("a window of any size draws its panels, which are in their places once it is large again",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("window.png");
    const Outcome outcome = inWindow({"run", squaresScene(), "--context", "window", "--size", "1x1",
                                      "--frames", "100000", "--screenshot", file},
                                     "for size in '5000 40' '1 300' '300 1' '90 60' '1 1' '800 600'; do\n"
                                     "  xdotool windowsize $w $size; settle; settle\n"
                                     "done\n"
                                     "close\n");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.messages().empty());
    const Image image = readPng(file);
    CHECK(image.width == 800);
    CHECK(image.height == 600);
    CHECK(brightness(image, 20, 14, 90, 10) > 25);  // the title of the panel
    CHECK(brightness(image, 20, 14, 90, 10) < 160);
    CHECK(brightness(image, 2, 20, 8, 400) > 110);  // the sky beside it
}

TEST_CASE("a window that is told to end closes, and ends by the signal", "[.window]") {
    const Scratch scratch;
    StartedShoal window({"run", squaresScene(), "--context", "window", "--size", "320x240", "--save",
                         scratch.path("s.shoal"), "--save-frames", "1"});
    window.waitForFile(scratch.path("s.shoal"));
    window.send(SIGTERM);
    const Outcome outcome = window.finish();
    INFO(outcome.err);
    CHECK(outcome.signal == SIGTERM);
    CHECK_THAT(outcome.err, Catch::Contains("a second signal ends it at once"));
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"s.shoal"});
}

TEST_CASE("a window saves when it closes, and goes on from there", "[.window]") {
    const Scratch scratch;
    const std::string first = scratch.path("first.shoal"), second = scratch.path("second.shoal");
    const auto window = [](const Words& more) {
        Words words{"run", squaresScene(), "--context", "window", "--size", "320x240", "--frames", "3"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = runShoal(words);
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        return outcome;
    };
    CHECK_THAT(window({"--save", first}).out, Catch::Contains("saved: " + first));
    window({"--resume", first, "--save", second});
    const auto hash = [](const Words& more) {
        Words words{"run", squaresScene(), "--headless", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return member(runShoal(words).json(), "hash").text;
    };
    CHECK(hash({"--frames", "2", "--resume", second}) == hash({"--frames", "8"}));
}

TEST_CASE("a run that blows up leaves the window open and says so", "[.window]") {
    const Scratch scratch;
    const std::string scene = scratch.write("storm.scene.json", R"({
  "format": "shoal-scene-1",
  "fields": [{"type": "uniform", "velocity": [1e15, 0, 0]}],
  "groups": [{"molecule": ")" + sourceFile("molecules/point.json") + R"(", "count": 3, "drag": 1000,
    "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]
})");
    const Outcome outcome =
        runShoal({"run", scene, "--context", "window", "--size", "640x480", "--frames", "9"},
                 {.folder = scratch.path("")});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("shoal: warning: ") && Catch::Contains("stopped at frame 1"));
    CHECK(outcome.messages().size() == 1);
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"storm.scene.json", "storm.watchdog.shoal"});
}

TEST_CASE("a window goes on while a driver compiles for long", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("slow.scene.json", R"({
  "format": "shoal-scene-1",
  "solver": {"method": "bdf2-corotated"},
  "groups": [{"molecule": "fish", "count": 3, "held": false,
    "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]
})");
    const Outcome outcome = inWindow({"run", scene, "--context", "window", "--size", "320x240"},
                                     "grep -q w \"$dir/frames\"\nclose\n",
                                     {.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}}});
    CHECK(outcome.code == 0);
}

TEST_CASE("a scene is not shown faster than it goes", "[.window]") {
    const Scratch scratch;
    const std::string scene = scratch.write("points.scene.json", R"({
  "format": "shoal-scene-1", "frameRate": 20,
  "groups": [{"molecule": "point", "count": 1,
    "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]
})");
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        runShoal({"run", scene, "--context", "window", "--size", "64x64", "--frames", "41"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(std::chrono::steady_clock::now() - start > std::chrono::milliseconds(1900));
}

TEST_CASE("a scene that does not load opens no window", "[.window]") {
    refusal({"run", "missing.scene.json", "--context", "window"}, "no such file");
}
