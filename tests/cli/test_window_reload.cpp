// The window follows its files: broken, fixed and changed on disk while it runs. Needs a display and xdotool.
#include "cli/shoal_command.h"
#include "cli/window_user.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/replaced.h"
#include "support/scratch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr const char* blades = R"({
  "format": "shoal-scene-1", "name": "blades", "gravity": [0, -9.81, 0],
  "groups": [
    {"name": "grass", "molecule": "blade.json", "count": 5,
      "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 0, 1]}}},
    {"name": "weeds", "molecule": "weed.json", "count": 5,
      "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 0, 1]}}}]
}
)";

constexpr const char* dust = R"({
  "format": "shoal-scene-1",
  "name": "dust",
  "groups": [
    {"name": "dust", "particle": {"size": 0.02}, "count": 5,
      "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 0, 1]}}}
  ]
}
)";

}  // namespace

// A file is broken and fixed, a molecule is changed in place and then in shape: the run goes on throughout.
TEST_CASE("changed files are taken while the scene runs, broken ones are not", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("blades.scene.json", blades);
    const std::string blade = scratch.write("blade.json", smallMolecule);
    const std::string weed = scratch.write("weed.json", smallMolecule);
    const std::string stiffer = replaced(smallMolecule, "\"stiffness\": 20", "\"stiffness\": 40");
    scratch.write("broken", replaced(smallMolecule, "\"b\": 2}", "\"b\": 9}"));
    scratch.write("stiffer", stiffer);
    scratch.write("larger",
                  replaced(stiffer, "[-0.1, 0.2, 0.05]}", "[-0.1, 0.2, 0.05]}, {\"position\": [0, 0.4, 0]}"));
    // saved by renaming, as editors do
    const Outcome outcome = inWindow(
        {"run", scene, "--context", "window", "--size", "480x360", "--save", scratch.path("end.shoal")},
        "cd " + scratch.path("") +
            "\nsave() { cp $1 $2.new; mv $2.new $2; }\n"
            "save broken blade.json; says not.reloaded:; save stiffer blade.json; says '^reloaded:'\n"
            "save larger weed.json; says '^reloaded:' 2; key Escape\n");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    const std::vector<std::string> messages = outcome.messages();
    REQUIRE(messages.size() == 1);
    CHECK_THAT(messages[0], Catch::Contains("not reloaded: " + blade + ":10:"));
    CHECK_THAT(outcome.out, Catch::Contains("reloaded: " + blade + "\n") &&
                                Catch::Contains("reloaded: " + weed + "; begins anew: weeds\n"));
    // what was saved at the end is of the scene as the files are now, and not of its beginning
    const Outcome on = runShoal(
        {"run", scene, "--headless", "--frames", "1", "--resume", scratch.path("end.shoal"), "--json"});
    INFO(on.err);
    CHECK(on.code == 0);
}

TEST_CASE("a shader that the driver refuses leaves the old programs running", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string scene = scratch.write("dust.scene.json", dust);
    namespace fs = std::filesystem;
    for (const char* folder : {"shaders", "molecules"})
        fs::copy(sourceFile(folder), scratch.folder() / folder, fs::copy_options::recursive);
    const std::string shader = scratch.path("shaders/render/tone.glsl");
    scratch.write("whole", readFile(shader));
    scratch.write("broken", replaced(readFile(shader), "radiance * 0.5", "radiance * half_"));
    const Outcome outcome = inWindow({"run", scene, "--context", "window", "--size", "480x360"},
                                     "cd " + scratch.path("") +
                                         "\ncp broken shaders/render/tone.glsl; says not.reloaded:\n"
                                         "cp whole shaders/render/tone.glsl; says '^reloaded:'; key Escape\n",
                                     {.environment = {{"SHOAL_DATA", scratch.path("")}}});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    REQUIRE(outcome.messages().size() == 1);
    CHECK_THAT(outcome.messages()[0], Catch::Contains("not reloaded: " + shader + ":"));
    CHECK_THAT(outcome.out, Catch::Contains("reloaded: " + shader));
}

TEST_CASE("without a scene the window lists those to choose from, and others open while one runs",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    scratch.write("a/dust.scene.json", dust);
    scratch.write("blades.scene.json", blades);
    scratch.write("blade.json", smallMolecule);
    scratch.write("weed.json", smallMolecule);
    scratch.write("zero.scene.json", "{}");
    // 600 x 400: the list is in the middle: blades, dust, zero
    const Outcome outcome =
        inWindow({"run", scratch.path(""), "--context", "window", "--size", "600x400"},
                 "press 100 125; says opened:; settle; key o; press 100 207; says opened: 2; settle\n"
                 "key o; press 100 289; says not.opened:; settle; key Escape; key Escape\n");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("opened: " + scratch.path("blades.scene.json")) &&
                                Catch::Contains("opened: " + scratch.path("a/dust.scene.json")));
    REQUIRE(outcome.messages().size() == 1);
    CHECK_THAT(outcome.messages()[0],
               Catch::Contains("not opened: " + scratch.path("zero.scene.json") + ":1:1: "));
}
