// Editing in the window: a slider is dragged, the scene is saved, and the file says so. Needs a display and
// xdotool, which moves the pointer.
#include <sstream>

#include "cli/shoal_command.h"
#include "cli/window_user.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr const char* fountain = R"({
  "format": "shoal-scene-1",
  "name": "fountain",
  "seed": 18446744073709551615,
  "gravity": [0, -9.810, 0],
  "groups": [
    {"name": "water", "comment": "kept",
      "particle": {"size": [0.010, 0.02], "colors": [{"color": [0.4, 0.6, 1]}, {"age": 1, "opacity": 0}]},
      "emitters": [
        {"from": "point", "rate": 100, "direction": [0, 7, 0], "spread": 0.20, "speed": [4, 5]}
      ],
      "life": {"span": [1, 2]}}
  ]
}
)";

struct Edited {
    Outcome outcome;
    std::string between, after;  // the file, at "keep" and at the end
};

Edited edit(const std::string& name, const std::string& steps) {
    const Scratch scratch;
    const std::string file = scratch.write(name + ".scene.json", fountain);
    const std::string words = "file=" + file +
                              "\nkeep() { cp $file $file.kept; }\n"
                              "hide() { mv $file $file.hidden; mkdir $file; }\n"
                              "show() { rmdir $file; mv $file.hidden $file; }\n";
    Edited out;
    out.outcome = inWindow({"run", file, "--context", "window", "--size", "900x640"}, words + steps);
    INFO(out.outcome.err);
    REQUIRE(out.outcome.code == 0);
    out.after = readFile(file);
    out.between = readFile(file + ".kept");
    const Outcome checked = runShoal({"check", file});
    INFO(checked.err);
    CHECK(checked.code == 0);
    return out;
}

const JsonValue& emittersIn(const JsonValue& root) {
    return member(member(root, "groups").items[0], "emitters");
}

// All that a scene says, at the right; `$file` in the steps, which is begun where it is not there.
Outcome editWhole(const std::string& file, const std::string& steps) {
    const Outcome out = inWindow({"edit", file, "--size", "900x640"}, "file=" + file + "\n" + steps);
    INFO(out.out << out.err);
    REQUIRE(out.code == 0);
    return out;
}

// In the right panel, with one group and one emitter, which is folded to add another.
constexpr const char* places =
    "rate() { drag 700 519 $1; }\nsave() { press 540 51; }\nrevert() { press 595 51; }\n"
    "addEmitter() { press 580 390; press 567 408; }\nabandon() { press 390 329; }\n";

}  // namespace

TEST_CASE("what is dragged and added in the window is saved, and no other byte changes", "[.window]") {
    if (!hasXdotool()) return;
    const Edited edited = edit("dragged", std::string(places) +
                                              "rate 850; control s; keep\n"
                                              "addEmitter; save; key Escape\n");
    CHECK(edited.outcome.err.empty());
    const JsonValue between = parseJson(edited.between, "between"), after = parseJson(edited.after, "after");
    const double rate = member(emittersIn(between).items[0], "rate").number;
    CHECK(rate > 200);
    std::string expected = fountain;
    const auto replace = [&](const std::string& part, const std::string& with) {
        const size_t at = expected.find(part);
        REQUIRE(at != std::string::npos);
        expected.replace(at, part.size(), with);
    };
    replace("\"rate\": 100", "\"rate\": " + writeJsonLine(JsonValue::makeNumber(rate)));
    // the capacity that followed the rate stays what it was
    replace("\"span\": [1, 2]", "\"span\": [1, 2], \"capacity\": 210");
    CHECK(edited.between == expected);

    REQUIRE(emittersIn(after).items.size() == 2);
    CHECK(member(emittersIn(after).items[1], "rate").number == rate);
}

TEST_CASE("a scene from nothing: a collider is added, moved in the picture, saved and taken back",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("new.scene.json");
    const std::string steps =
        "cp $file $file.begun\n"
        "press 600 192; press 567 228; press 614 263\n"  // colliders, Add, sphere, which opens
        "at 450 303; xdotool mousedown 1; settle; at 400 253; xdotool mouseup 1; settle\n"
        "control s; cp $file $file.kept\n"
        "control z; control z; control s\n"
        "key Escape\n";
    const Outcome outcome = editWhole(file, steps);
    CHECK(outcome.err.empty());
    const std::string begun = readFile(file + ".begun"), kept = readFile(file + ".kept");
    const size_t added = kept.find(",\n    {\"type\": \"sphere\", \"center\": [");
    REQUIRE(added != std::string::npos);
    std::string without = kept;
    CHECK(without.erase(added, kept.find('}', added) + 1 - added) == begun);
    const JsonValue root = parseJson(kept, file);
    const JsonValue& center = member(member(root, "colliders").items[1], "center");
    // 50 pixels to the left and up of 640 that show 2 tan(0.4) of 5.2 m
    CHECK(center.items[0].number == Approx(-0.34).margin(0.05));
    CHECK(center.items[1].number == Approx(1.34).margin(0.05));  // it stood on the ground
    CHECK(readFile(file) == begun);
    CHECK(runShoal({"run", file + ".kept", "--headless", "--frames", "2"}).code == 0);
}

TEST_CASE("what was added in the window and what changed on disk come together", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("both.scene.json");
    const std::string steps =
        "press 600 192; press 567 228; press 614 263\n"
        "sed -i 's/-9.81/-1.62/' $file; says '^reloaded:'\n"
        "control s; key Escape\n";
    const Outcome outcome = editWhole(file, steps);
    const JsonValue root = readJson(file);
    CHECK(member(root, "gravity").items[1].number == -1.62);
    REQUIRE(member(root, "colliders").items.size() == 2);
}

TEST_CASE("what cannot run stays in the panel until it is dropped", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("last.scene.json");
    // the only group is removed; dropping that brings it back, and nothing is to be saved
    const std::string steps =
        "cp $file $file.begun\n"
        "press 600 138; press 600 156; press 662 174\n"
        "says 'at least'; control s\n"
        "press 770 75; key Escape\n";
    const Outcome outcome = editWhole(file, steps);
    CHECK(readFile(file) == readFile(file + ".begun"));
    REQUIRE(outcome.messages().size() == 2);
    CHECK_THAT(outcome.messages()[0], Catch::Contains("$.groups"));
    CHECK_THAT(outcome.messages()[1], Catch::Contains("not saved"));
}

TEST_CASE("what is typed in a row is saved by a click on Save, and what is only shown stays as it is",
          "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("typed.scene.json");
    // a quaternion, which its row shows as an axis and an angle
    const std::string steps =
        "sed -i 's/{\"type\": \"plane\"}/{\"type\": \"box\", \"center\": [0, 0, 0], \"size\": [1, 1, 1], "
        "\"rotation\": [0, 0.6, 0, 0.8]}/' $file\n"
        "says '^reloaded:'; cp $file $file.before\n"
        "press 600 192; press 600 210\n"
        "press 760 99; xdotool type --delay 60 leaves; settle; press 549 51; key Escape\n";
    const Outcome outcome = editWhole(file, steps);
    std::string expected = readFile(file + ".before");
    const size_t name = expected.find("\"typed\"");
    REQUIRE(name != std::string::npos);
    CHECK(readFile(file) == expected.replace(name, 7, "\"typedleaves\""));
}

TEST_CASE("rows are reached, opened, added, ticked and typed by the keyboard alone", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.path("keys.scene.json");
    // to the fields, which open; the first kind is added; from below its box is ticked, its weight typed
    const std::string steps =
        "cp $file $file.begun\n"
        "for i in 1 2 3 4 5; do key Down; done; key Right; key Down; key space; key space\n"
        "key Up; key space; key Up; key Return; xdotool type --delay 60 0.5; settle; key Return\n"
        "control s; close\n";
    const Outcome outcome = editWhole(file, steps);
    CHECK(outcome.err.empty());
    std::string expected = readFile(file + ".begun");
    const size_t end = expected.rfind("\n}");
    REQUIRE(end != std::string::npos);
    expected.insert(end,
                    ",\n  \"fields\": [\n    {\"type\": \"uniform\", \"velocity\": [0, 0, 0], \"box\": "
                    "{\"low\": [-1, -1, -1], \"high\": [1, 1, 1]}, \"weight\": 0.5}\n  ]");
    CHECK(readFile(file) == expected);
}

TEST_CASE("a number typed beyond its limit is taken to it, one beyond its slider as it is", "[.window]") {
    if (!hasXdotool()) return;
    const Edited edited =
        edit("typed",
             "field() { xdotool keydown ctrl; press 760 519; xdotool keyup ctrl; settle; }\n"
             "field; xdotool type --delay 60 9000; settle; key Return; control s; keep\n"
             "field; xdotool type --delay 60 -- -5; settle; key Return; control s; close\n");
    const auto rate = [](const std::string& text) {
        return member(emittersIn(parseJson(text, "text")).items[0], "rate").number;
    };
    CHECK(rate(edited.between) == 9000);
    CHECK(rate(edited.after) == 0);
}

TEST_CASE("the time line goes back to a state that was kept", "[.window]") {
    if (!hasXdotool()) return;
    const Scratch scratch;
    const std::string file = scratch.write("kept.scene.json", fountain);
    // the first state, while the run goes on; then on from there, and back again
    const std::string steps =
        "key t; settle; settle; settle; settle; settle; settle\n"
        "press 420 608; says 'went to frame [1-9][0-9]*, paused'\n"
        "key space; settle; settle; settle; settle; press 420 608; says 'went to frame' 2\n"
        "key Escape\n";
    const Outcome outcome = inWindow({"run", file, "--context", "window", "--size", "900x640"}, steps);
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    std::vector<std::string> went;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("went to", 0) == 0) went.push_back(line);
    REQUIRE(went.size() == 2);
    CHECK(went[0] == went[1]);
}

TEST_CASE("a file that changes on disk keeps what was dragged in the window, or the window asks",
          "[.window]") {
    if (!hasXdotool()) return;
    // sed writes another file and renames it; the second change is of what was dragged
    const Edited edited =
        edit("merged",
             std::string(places) +
                 "rate 850; sed -i 's/-9.810/-1.62/' $file; says '^reloaded:'; save; keep\n"
                 "rate 750; sed -i 's/\"rate\": [0-9.]*/\"rate\": 33/' $file\n"
                 "says 'not reloaded yet:'; settle; press 264 355; says '^reloaded:' 2; save; key Escape\n");
    INFO(edited.outcome.out << edited.between << edited.after);
    REQUIRE(edited.outcome.messages().size() == 1);
    CHECK_THAT(edited.outcome.messages()[0], Catch::Contains("both changed") && Catch::Contains("rate"));
    const JsonValue between = parseJson(edited.between, "between"), after = parseJson(edited.after, "after");
    const auto rate = [](const JsonValue& root) { return member(emittersIn(root).items[0], "rate").number; };
    CHECK(member(between, "gravity").items[1].number == -1.62);
    CHECK(rate(between) > 200);
    CHECK(rate(after) != 33);
    CHECK(rate(after) < rate(between));
}

TEST_CASE("a file that becomes garbage or goes away while it is edited takes nothing from the window",
          "[.window]") {
    if (!hasXdotool()) return;
    // saving writes over no garbage, and anew what is gone; no undo leads back beyond what came from disk
    const Edited edited =
        edit("garbage", std::string(places) +
                            "rate 850; echo '{ garbage' > $file; says 'not reloaded:'; settle\n"
                            "save; says 'not saved:'; keep; mv $file $file.hidden; settle; save; settle\n"
                            "sed 's/-9.810/-1.62/' $file > $file.new; mv $file.new $file; says '^reloaded:'\n"
                            "settle; control z; settle; save; key Escape\n");
    INFO(edited.outcome.out << edited.outcome.err << edited.after);
    CHECK(edited.between == "{ garbage\n");
    const std::vector<std::string> messages = edited.outcome.messages();
    REQUIRE(messages.size() >= 2);
    CHECK_THAT(messages[0], Catch::Contains("not reloaded") && Catch::Contains(":1:3: expected a key"));
    CHECK_THAT(messages[1], Catch::Contains("not saved") && Catch::Contains("has changed since it was read"));
    const JsonValue after = parseJson(edited.after, "after");
    CHECK(member(after, "gravity").items[1].number == -1.62);
    CHECK(member(emittersIn(after).items[0], "rate").number > 200);
}

TEST_CASE("a question goes when the file agrees again, and the window listens", "[.window]") {
    if (!hasXdotool()) return;
    const Edited edited = edit("agreed", std::string(places) +
                                             "keep; rate 850; sed -i 's/\"rate\": 100/\"rate\": 33/' $file\n"
                                             "says 'not reloaded yet:'; settle; cp $file.kept $file\n"
                                             "says '^reloaded:'; settle; save; key Escape\n");
    CHECK(member(emittersIn(parseJson(edited.after, "after")).items[0], "rate").number > 200);
}

TEST_CASE("what is reverted or abandoned in the window is not saved", "[.window]") {
    if (!hasXdotool()) return;
    // between, the file cannot be saved: for a while a folder stands in its place
    const Edited edited = edit("abandoned", std::string(places) +
                                                "rate 850; revert; save; keep; rate 680\n"
                                                "hide; save; says not.saved:; show; key Escape; abandon\n");
    CHECK(edited.between == fountain);
    CHECK(edited.after == fountain);
    const std::vector<std::string> messages = edited.outcome.messages();
    REQUIRE(messages.size() == 2);
    CHECK_THAT(messages[0], Catch::Contains("warning: not saved: ") && Catch::Contains("is a folder"));
    CHECK_THAT(messages[1], Catch::Contains("warning: what was changed in the window was not saved"));
}
