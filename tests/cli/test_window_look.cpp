// Looking closer in the window: a molecule is picked, springs and arrows are drawn, pictures and videos
// taken. Needs a display and xdotool.
#include "cli/shoal_command.h"
#include "cli/window_user.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// One large triangle that hangs still in the middle of the picture, in a steady wind that does not move it.
constexpr const char* still = R"({
  "format": "shoal-scene-1", "name": "still",
  "fields": [{"type": "uniform", "velocity": [2, 0, 0]}],
  "groups": [
    {"name": "sail", "molecule": "sail.json", "count": 1, "place": {"on": "list", "items": [{"position": [0, 0, 0]}]},
     "drag": 1e-6}
  ],
  "camera": {"eye": [0, 0, 3], "target": [0, 0, 0]}
}
)";
constexpr const char* sail = R"({
  "format": "shoal-molecule-1", "name": "sail",
  "defaults": {"mass": 1, "stiffness": 20},
  "vertices": [{"position": [-0.5, -0.4, 0]}, {"position": [0.5, -0.4, 0]}, {"position": [0, 0.5, 0]}],
  "springs": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}],
  "triangles": [[0, 1, 2]],
  "material": {"color": [0.02, 0.3, 0.02]}
}
)";

int differing(const Image& a, const Image& b) {
    int out = 0;
    for (size_t i = 0; i < a.pixels.size(); i += 4)
        out += std::abs(int(a.pixels[i]) - int(b.pixels[i])) +
                   std::abs(int(a.pixels[i + 2]) - int(b.pixels[i + 2])) >
               60;
    return out;
}

}  // namespace

TEST_CASE("a molecule is picked by a click, and pictures show what is switched on", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("still.scene.json", still);
    scratch.write("sail.json", sail);
    scratch.write("still-002.png", "mine");  // is not written over
    // a click beside it picks nothing; the pictures: plain, with springs, with arrows as well, without both,
    // from the side
    const Outcome outcome =
        inWindow({"run", scene, "--context", "window", "--size", "900x500"},
                 "press 420 80; press 450 250\n"
                 "key Escape; key p; key x; key p; key f; key p; key x; key f; key p; key 2; key p\n"
                 "key v; key v; key Escape\n",
                 {.folder = scratch.path("")});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.messages().empty());
    const size_t at = outcome.out.find("picked: sail 0");
    REQUIRE(at != std::string::npos);
    CHECK(outcome.out.find("picked", at + 1) == std::string::npos);
    CHECK_THAT(outcome.out,
               Catch::Contains("recorded: still-001.mp4, ") || Catch::Contains("recorded: still-001, "));

    const auto picture = [&](const char* name) { return readPng(scratch.path(name)); };
    const Image plain = picture("still-001.png"), springs = picture("still-003.png");
    const Image arrows = picture("still-004.png"), again = picture("still-005.png");
    const Image side = picture("still-006.png");
    CHECK(plain.width == 900);
    CHECK(plain.height == 500);
    CHECK(differing(plain, springs) > 200);
    CHECK(differing(springs, arrows) > 200);
    CHECK(differing(plain, again) == 0);
    CHECK(differing(plain, side) > 5000);
    CHECK(readFile(scratch.path("still-002.png")) == "mine");
}

TEST_CASE("a video that is recorded when the window closes is whole", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("still.scene.json", still);
    scratch.write("sail.json", sail);
    const Outcome outcome = inWindow({"run", scene, "--context", "window", "--size", "320x240"},
                                     "key v; settle; key Escape\n", {.folder = scratch.path("")});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.messages().empty());
    CHECK_THAT(outcome.out,
               Catch::Contains("recorded: still-001.mp4, ") || Catch::Contains("recorded: still-001, "));
}

TEST_CASE("a picture that is saved is full while the rate is kept, and so is the window's once it rests",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    std::string text = still;  // with a ground that takes long to draw
    text.insert(text.find("\"groups\""),
                "\"colliders\": [{\"type\": \"plane\", \"point\": [0, -0.5, 0]}],\n  ");
    const std::string scene = scratch.write("still.scene.json", text);
    scratch.write("sail.json", sail);
    // while it runs, and long after it was paused; the window's own picture is the same then
    const Outcome outcome = inWindow(
        {"run", scene, "--context", "window", "--size", "1800x1200", "--frames", "100000", "--screenshot",
         scratch.path("all.png")},
        "settle; settle; settle; settle; settle; settle; settle; settle; settle; settle; settle; settle\n"
        "key h; key p; key space; settle; settle; sleep 1; settle; key p; key Escape\n",
        {.folder = scratch.path("")});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    const auto picture = [&](const char* name) {
        Image out = readPng(scratch.path(name));
        CHECK(out.width == 1800);
        CHECK(out.height == 1200);
        out.pixels.resize(out.pixels.size() * 11 / 12);  // without the line that tells of pictures
        return out;
    };
    const Image moving = picture("still-001.png"), resting = picture("still-002.png");
    CHECK(differing(moving, resting) == 0);
    CHECK(differing(resting, picture("all.png")) == 0);
}

// Clicks beside the molecule pick nothing, and a drag turns the camera: four times picked, twice let go.
TEST_CASE("what is done within one frame is taken in its order", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("still.scene.json", still);
    scratch.write("sail.json", sail);
    const Outcome outcome =
        inWindow({"run", scene, "--context", "window", "--size", "900x500"},
                 "inOneFrame 'press 450 250; press 420 80; press 450 250; key Escape; press 440 260'\n"
                 "key Escape; inOneFrame 'key 2; press 440 260; key 1; press 450 250; key Escape; key p'\n"
                 "key Escape\n",
                 {.folder = scratch.path("")});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    size_t picked = 0;
    for (size_t at = 0; (at = outcome.out.find("picked: sail 0", at)) != std::string::npos; ++at)
        ++picked;
    CHECK(picked == 4);
    CHECK_THAT(outcome.out, Catch::Contains("picture: still-001.png"));
}
