// The molecule editor, as a user works it: through a real window's pointer and keys.
#include <csignal>

#include "cli/shoal_command.h"
#include "cli/window_user.h"
#include "core/file.h"
#include "core/image.h"
#include "molecule/molecule_file.h"
#include "support/catch.h"
#include "support/replaced.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// In front of the eye (key 1) vertex 2 is at 565, 159 of a window of 900 x 640, and vertex 0 at 335, 389.
constexpr const char* square = R"({
  "format": "shoal-molecule-1", "comment": "kept",
  "defaults": {"mass": 0.10, "stiffness": 50, "damping": 0.5},
  "vertices": [
    {"position": [0, 0, 0.00]}, {"position": [1.0, 0, 0], "comment": "a corner"},
    {"position": [1, 1, 0]}, {"position": [0, 1, 0]}
  ],
  "springs": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}],
  "triangles": [[0, 1, 2], [0, 2, 3]]
}
)";

struct Session {
    Scratch scratch;
    std::string file;
    Surroundings surroundings;

    explicit Session(const std::string& name) : file(scratch.write(name + ".json", square)) {
        surroundings.environment["XDG_STATE_HOME"] = scratch.path("state");
    }
    // From in front.
    Outcome edit(const std::string& steps) {
        return inWindow({"edit", file, "--size", "900x640"}, "file=" + file + "\nkey 1\n" + steps,
                        surroundings);
    }
    std::string text() const { return readFile(file); }
    Molecule molecule() const { return readMolecule(file); }
};

}  // namespace

TEST_CASE("a vertex is dragged, saved, taken back and saved again in the editor", "[.window]") {
    if (!hasXdotool()) return;
    Session session("dragged");
    const Outcome out = session.edit(
        "drag 565 159 611; control s; cp $file $file.moved\n"
        "control z; control s; cp $file $file.back; control y; control s; close\n");
    CHECK(out.code == 0);
    CHECK(out.err.empty());
    const Molecule moved = readMolecule(session.file + ".moved");
    CHECK(moved.vertices[2].position.x == Approx(1.2).margin(0.02));
    CHECK(moved.vertices[2].position.y == Approx(1).margin(0.02));
    CHECK(readFile(session.file + ".back") == square);
    // nothing but the numbers of that vertex
    const JsonValue json = readJson(session.file);
    const std::string number = writeJsonLine(JsonValue::makeVector(session.molecule().vertices[2].position));
    CHECK(number != "[1, 1, 0]");
    CHECK(session.text() == replaced(square, "[1, 1, 0]", number));
}

TEST_CASE("a molecule whose texture is missing is edited all the same", "[.window]") {
    const Scratch scratch;
    const std::string file = scratch.write(
        "bare.json",
        replaced(square, "\"vertices\"", "\"material\": {\"texture\": \"none.png\"}, \"vertices\""));
    const Outcome out = runShoal({"edit", file, "--size", "320x240", "--frames", "3"},
                                 {.environment = {{"XDG_STATE_HOME", scratch.path("state")}}});
    CHECK(out.code == 0);
    CHECK_THAT(out.err, Catch::Contains("none.png"));
}

TEST_CASE("what is done in the editor within one frame is taken in its order", "[.window]") {
    if (!hasXdotool()) return;
    Session session("slow");
    const Outcome out = session.edit(
        "inOneFrame 'drag 565 159 611; control s; key Escape; press 335 389; key p; control z; key p; "
        "control s'\n"
        "close\n");
    CHECK(out.code == 0);
    const Molecule m = session.molecule();
    CHECK(m.vertices[2].position.x == Approx(1.2).margin(0.02));
    CHECK(m.vertices[0].pinned);
    CHECK_FALSE(m.vertices[2].pinned);
}

TEST_CASE("springs and vertices are added, removed and pinned in the editor", "[.window]") {
    if (!hasXdotool()) return;
    Session session("changed");
    const Outcome out = session.edit(
        "key s; xdotool mousemove --window $w 565 389 mousedown 1 mousemove --window $w 335 159 mouseup 1; "
        "settle\n"
        "key v; press 335 389; key p; control s; cp $file $file.braced\n"
        "press 565 159; key Delete; control s; close\n");
    CHECK(out.code == 0);
    CHECK(out.err.empty());
    const Molecule braced = readMolecule(session.file + ".braced");
    REQUIRE(braced.springs.size() == 6);
    CHECK(braced.springs[5].a + braced.springs[5].b == 4);
    CHECK(braced.vertices[0].pinned);
    const Molecule m = session.molecule();
    CHECK(m.vertices.size() == 3);
    CHECK(m.springs.size() == 3);
    CHECK(m.triangles.empty());
    CHECK(session.text().find("a corner") != std::string::npos);
}

TEST_CASE("a file that another program breaks and mends is said and taken up in the editor", "[.window]") {
    if (!hasXdotool()) return;
    Session session("broken");
    const Outcome out = session.edit(
        "cp $file $file.whole; key space\n"
        "printf '{\"format\": 3' > $file; says broken.json:1:\n"
        "sed s/0.10/0.30/ $file.whole > $file; says '^reloaded:'\n"
        "key space; key Home; drag 565 159 611; control s; close\n");
    CHECK(out.code == 0);
    const std::vector<std::string> messages = out.messages();
    REQUIRE(messages.size() == 1);
    CHECK_THAT(messages[0], Catch::Contains("broken.json:1:"));
    CHECK(session.molecule().vertices[0].mass == 0.3);
    CHECK(session.molecule().vertices[2].position.x > 1.1);
}

TEST_CASE("what is not saved outlives the editor, and is offered again", "[.window]") {
    if (!hasXdotool()) return;
    Session session("killed");
    const Outcome killed = session.edit(
        "drag 565 159 611; await 'ls $XDG_STATE_HOME/shoal/unsaved/*.json > /dev/null 2>&1'\n"
        "kill -9 $(cat $dir/pid)\n");
    CHECK(killed.code == -1);
    CHECK(session.text() == square);
    // "Take it", then save
    const Outcome out = session.edit("press 229 330; control s; close\n");
    CHECK(out.code == 0);
    CHECK(session.molecule().vertices[2].position.x > 1.1);
    CHECK(session.text().find("a corner") != std::string::npos);
    CHECK(filesIn(session.scratch.path("state")).empty());
}

TEST_CASE("a molecule is made from nothing in the editor", "[.window]") {
    if (!hasXdotool()) return;
    Session session("new");
    const std::string file = session.scratch.path("kite.json");
    const auto edit = [&](const std::string& steps, std::vector<std::string> more) {
        more.insert(more.begin(), {"edit", file, "--size", "900x640"});
        return inWindow(more, "file=" + file + "\n" + steps, session.surroundings);
    };
    // closed without saving there is no file
    edit("key Escape; key Escape; press 460 329\n", {"--shape", "rod"});
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK(filesIn(session.scratch.path("state")).empty());
    edit("key ctrl+s; key Escape\n", {});
    const Molecule made = readMolecule(file);
    CHECK(made.name == "kite");
    CHECK(made.vertices.size() == 9);
    CHECK(made.size() == Approx(0.2 * std::sqrt(2)));
}

TEST_CASE("closing the editor asks, and saves nothing without being told to", "[.window]") {
    if (!hasXdotool()) return;
    Session session("closed");
    const Outcome out = session.edit("drag 565 159 611; key Escape; key Escape; press 460 329\n");
    CHECK(out.code == 0);
    CHECK(session.text() == square);
    CHECK(filesIn(session.scratch.path("state")).empty());
}

TEST_CASE("the editor refuses what it cannot open", "[bad]") {
    const Scratch scratch;
    refusal({"edit", scratch.path("none.obj")}, "no such file");
    refusal({"edit", scratch.write("plain", "") + "/new.json"}, "plain");
    refusal({"edit", scratch.path("new.json"), "--shape", "rid"}, "did you mean \"rod\"");
    refusal({"edit", scratch.write("there.json", square), "--shape", "rod"},
            "--shape is for a file that is not");
    refusal({"edit", scratch.write("newer.json", replaced(square, "molecule-1", "molecule-2"))}, "newer");
    refusal({"edit", scratch.write("broken.json", "{")}, "broken.json:1:");
}

TEST_CASE("a molecule is drawn on a sheet", "[show]") {
    const Scratch scratch;
    const std::string file = scratch.write("square.json", square), sheet = scratch.path("sheet.png");
    if (!hasContext("egl")) return;
    const Outcome out = runShoal({"molecule", "show", file, "--capture", sheet, "--size", "960x570"});
    INFO(out.err);
    REQUIRE(out.code == 0);
    const Image image = readPng(sheet);
    REQUIRE(image.width == 960);
    REQUIRE(image.height == 570);
    // springs are green lines, normals blue ones; the soft motion is said in orange
    int green = 0, blue = 0, orange = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 4) {
        const int r = image.pixels[i], g = image.pixels[i + 1], b = image.pixels[i + 2];
        green += g > r + 30 && g > b + 50;
        blue += b > r + 90 && b > 150;
        orange += r > 200 && g > 140 && g < 210 && b < 110;
    }
    CHECK(green > 800);
    CHECK(blue > 60);
    CHECK(orange > 50);
    refusal({"molecule", "show", file, "--capture", sheet, "--size", "300x300"}, "480x240");
    refusal({"molecule", "show", file}, "--capture");
    refusal({"molecule", "show", scratch.path("none.json"), "--capture", sheet}, "no such file");
}
