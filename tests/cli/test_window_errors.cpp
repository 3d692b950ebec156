// An error is shown in the window until its cause is gone, and no longer. Needs a display and xdotool.
#include "cli/shoal_command.h"
#include "cli/window_user.h"
#include "core/file.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// One molecule that hangs still.
constexpr const char* still = R"({
  "format": "shoal-scene-1", "name": "still",
  "groups": [{"name": "blade", "molecule": "blade.json", "count": 1,
    "place": {"on": "list", "items": [{"position": [0, 0, 0]}]}}],
  "camera": {"eye": [0, 0, 3], "target": [0, 0, 0]}
}
)";

// The ground of messages is dark red.
bool showsMessage(const std::string& file) {
    const Image image = readPng(file);
    int red = 0;
    for (size_t i = 0; i < image.pixels.size(); i += size_t(image.channels)) {
        const int r = image.pixels[i], g = image.pixels[i + 1], b = image.pixels[i + 2];
        red += r > 40 && r < 80 && g < 40 && b < 40 && r > g + 15;
    }
    return red > 3000;
}

struct Seen {
    Outcome outcome;
    bool message;  // at the end
};

// Runs the scene with shaders of its own in `folder`, and looks at the window when it closes.
Seen see(const Scratch& scratch, const std::string& steps) {
    const std::string scene = scratch.write("still.scene.json", still), picture = scratch.path("end.png");
    scratch.write("blade.json", smallMolecule);
    Seen out;
    out.outcome = inWindow({"run", scene, "--context", "window", "--size", "480x400", "--frames", "1000000",
                            "--screenshot", picture},
                           "cd " + scratch.path("") + "\n" + steps + "settle; key Escape\n",
                           {.environment = {{"SHOAL_DATA", scratch.path("")}}});
    REQUIRE(out.outcome.code == 0);
    out.message = showsMessage(picture);
    return out;
}

}  // namespace

TEST_CASE("a program that is refused when it is needed first is an error until its file is mended",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    namespace fs = std::filesystem;
    for (const char* folder : {"shaders", "molecules"})
        fs::copy(sourceFile(folder), scratch.folder() / folder, fs::copy_options::recursive);
    const std::string lines = scratch.path("shaders/render/spring_lines.vert"), whole = readFile(lines);
    scratch.write("whole", whole);
    writeFile(lines, whole + "\nno shader\n");
    const Seen broken = see(scratch, "key x; says 'shoal: warning:'\n");
    CHECK(broken.message);
    CHECK(broken.outcome.messages().size() == 1);
    const Seen mended =
        see(scratch, "key x; says 'shoal: warning:'; cp whole " + lines + "; says '^reloaded:'\n");
    CHECK_FALSE(mended.message);
}

TEST_CASE("the editor's error of a file goes when the file is as it was", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.write("blade.json", smallMolecule), picture = scratch.path("end.png");
    const auto edit = [&](const std::string& steps) {
        const Outcome out =
            inWindow({"edit", file, "--size", "900x640", "--frames", "1000000", "--screenshot", picture},
                     "cd " + scratch.path("") +
                         "\ncp blade.json whole; echo '{' > blade.json; says blade.json:2:1:\n" + steps +
                         "settle; key Escape\n",
                     {.environment = {{"XDG_STATE_HOME", scratch.path("state")}}});
        CHECK(out.code == 0);
        scratch.write("blade.json", smallMolecule);
        return out;
    };
    edit("");
    CHECK(showsMessage(picture));
    // told again when it is broken again
    const Outcome twice = edit(
        "cp whole blade.json; says '^as before:'; echo '{' > blade.json\n"
        "says blade.json:2:1: 2; cp whole blade.json; says '^as before:' 2\n");
    CHECK_FALSE(showsMessage(picture));
    CHECK(twice.messages().size() == 2);
}
