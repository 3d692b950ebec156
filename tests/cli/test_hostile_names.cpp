// Names from files and of files reach terminals, ffmpeg, XML and GLSL as data only.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "cli/shoal_command.h"
#include "core/json.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Each part is a command, or an end of what stands before it, to one of those that get the name.
std::string hostile(const std::string& what) {
    return what +
           "\n!touch pwned\nshoal: error: forged\n`touch pwned` $(touch pwned)'; system('touch pwned')\n" +
           "\"\\\n#error pwned\n*/ #define main <&> @pwned {/:Bold %s} \x1b]0;pwned\x07\x1b[2J \u009b \u202e "
           "\x7f";
}

JsonValue word(const std::string& text) {
    return JsonValue::makeString(text);
}

// A scene in which all that can have a name has one.
std::string hostileScene(const Scratch& scratch, const std::string& file = "hostile.scene.json") {
    JsonValue scene = parseJson(R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0],
  "fields": [{"type": "gust", "direction": [1, 0, 0], "speed": 1}],
  "forces": [{"type": "attract", "position": [0, 1, 0], "strength": 1, "most": 5}],
  "colliders": [{"type": "plane"}, {"type": "sphere", "center": [0, -2, 0], "radius": 0.5}],
  "groups": [{"count": 4, "drag": 1, "place": {"on": "volume",
    "box": {"low": [-1, 0.6, -1], "high": [1, 2, 1]}, "turn": "any"}}]})",
                                "scene");
    scene.add("name", word(hostile("scene"))).add("comment", word(hostile("comment")));
    for (auto& [key, value] : scene.members)
        for (size_t i = 0; i < value.items.size(); ++i)
            value.items[i].add("name", word(hostile(i == 0 ? key : concat(key, i))));
    for (auto& [key, value] : scene.members)
        if (key == "groups") value.items[0].add("molecule", word(sourceFile("molecules/quad.json")));
    return scratch.write(file, writeJson(scene));
}

// Lines are ours, and nothing in them is more than text.
void checkSafe(const std::string& text) {
    INFO(text);
    for (const char* bad :
         {"\x1b", "\x07", "\x7f", "\u009b", "\u202e", "\n!touch", "\nshoal: error: forged", "\n#error"})
        CHECK(text.find(bad) == std::string::npos);
}

Surroundings in(const Scratch& scratch) {
    return {.folder = scratch.path(""), .environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
}

void checkUntouched(const Scratch& scratch) {
    for (const std::string& file : filesIn(scratch.path("")))
        CHECK(std::filesystem::path(file).filename().string() != "pwned");
}

Outcome runs(const Scratch& scratch, const Words& words) {
    const Outcome outcome = runShoal(words, in(scratch));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    checkSafe(outcome.out);
    checkSafe(outcome.err);
    checkUntouched(scratch);
    return outcome;
}

}  // namespace

TEST_CASE("names command no terminal, in reports, warnings and errors", "[cli]") {
    const Scratch scratch;
    const std::string scene = hostileScene(scratch);
    CHECK_THAT(runs(scratch, {"check", scene}).out, Catch::Contains("scene \"scene\\n!touch pwned"));
    CHECK(
        member(member(runs(scratch, {"check", scene, "--json"}).json().items.at(0), "scene"), "name").text ==
        hostile("scene"));
    CHECK_THAT(runs(scratch, {"explain", scene}).out, Catch::Contains("group \"groups\\n!touch pwned"));
    CHECK(member(runs(scratch, {"explain", scene, "--json"}).json(), "scene").text == hostile("scene"));
    CHECK_THAT(runs(scratch, {"scenes", scratch.path("")}).out,
               Catch::Contains("hostile.scene.json  comment\\n"));
    // names of files and words, in what is refused
    const std::string odd = "no\n!touch\nshoal: error: forged\x1b[2J\xff";
    for (const Words& words :
         {Words{"check", odd}, Words{"run", odd, "--headless"}, Words{"explain", odd + ".json"}, Words{odd},
          Words{"run", "--" + odd}, Words{"explain", scene, "--solver", odd}}) {
        const Outcome outcome = runShoal(words, in(scratch));
        CHECK(outcome.code != 0);
        CHECK(outcome.messages().size() == 1);
        checkSafe(outcome.err);
    }
    JsonValue wrong = readJson(scene);
    wrong.add(hostile("key"), word("x"));
    const Outcome refused =
        runShoal({"check", scratch.write("wrong.scene.json", writeJson(wrong))}, in(scratch));
    CHECK(refused.code == 1);
    CHECK(refused.messages().size() == 1);
    checkSafe(refused.err);
}

TEST_CASE("names are comments in generated GLSL, and a run of them writes where it was told", "[cli]") {
    const Scratch scratch;
    const std::string scene = hostileScene(scratch, "a\n!touch pwned\x1b[2J%d'.scene.json");
    const std::string kernel = runs(scratch, {"explain", scene, "--shader"}).out;
    for (size_t at = 0; (at = kernel.find("pwned", at)) != std::string::npos; ++at) {
        const size_t line = kernel.rfind('\n', at) + 1;
        CHECK(kernel.substr(line, at - line).find("//") != std::string::npos);
    }
    for (const char* path : {"fused", "ping-pong"}) {
        const Outcome outcome = runs(scratch, {"run", scene, "--headless", "--frames", "2", "--size", "64x64",
                                               "--capture", "-", "--path", path, "--export", "a&b\"<c>.pvd"});
        CHECK_THAT(outcome.out,
                   Catch::Contains("pictures: -, 2 pictures\n") &&
                       Catch::Contains("state: a&b\"<c>-00000.vtp to a&b\"<c>-00002.vtp, 3 files"));
    }
    CHECK(std::filesystem::exists(scratch / "-/frame-00002.png"));
    const std::string index = readFile(scratch / "a&b\"<c>.pvd");
    CHECK_THAT(index, Catch::Contains("file=\"a&#38;b&#34;&#60;c&#62;-00002.vtp\"/>"));
    CHECK(
        runShoal({"run", scene, "--headless", "--frames", "1", "--export", "a\x1b.pvd"}, in(scratch)).code ==
        1);
}

TEST_CASE("a video's name is no option, pattern or protocol", "[cli]") {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    const Scratch scratch;
    const std::string scene = hostileScene(scratch);
    const Words videos = {"-y %03d\n!touch pwned.mp4", "concat:x|y.mp4", "$(touch pwned) `x`.mkv"};
    for (const std::string& video : videos) {
        const Outcome outcome = runs(
            scratch, {"run", scene, "--headless", "--frames", "2", "--size", "64x64", "--capture=" + video});
        CHECK_THAT(outcome.out,
                   Catch::Contains("video: ") && Catch::Contains(".m") && Catch::Contains(", 2 pictures"));
        CHECK(std::filesystem::file_size(scratch / video) > 500);
    }
}
