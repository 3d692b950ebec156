// Bad files: the program says where and what, fails, and writes nothing.
#include <algorithm>
#include <filesystem>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/replaced.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// "line:column" of a piece of text.
std::string placeOf(const std::string& text, const std::string& part) {
    const size_t at = text.find(part);
    REQUIRE(at != std::string::npos);
    const size_t start = text.rfind('\n', at);  // npos + 1 is 0
    return concat(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'), ":", at - start);
}

// Runs the scene towards pictures and an export, which must not come to be.
std::string refusedRun(const Scratch& scratch, const std::string& scene, const std::string& part) {
    const std::string message =
        refusal({"run", scene, "--headless", "--frames", "2", "--size", "64x64", "--capture",
                 scratch.path("out/p"), "--export", scratch.path("out/x.csv")},
                part);
    CHECK(filesIn(scratch.path("out")).empty());
    return message;
}

struct Change {
    const char *from, *to;  // in the file
    const char* at;         // text at which the message points, in the changed file; empty: anywhere
    const char* message;
};

}  // namespace

TEST_CASE("the scene that the bad ones are made from runs", "[cli]") {
    const Scratch scratch;
    const Outcome outcome = runShoal({"run", writeSmallScene(scratch), "--headless", "--frames", "2",
                                      "--size", "64x64", "--capture", scratch.path("out"), "--json"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(filesIn(scratch.path("out")).size() == 2);
}

TEST_CASE("no scene at all", "[cli]") {
    const Scratch scratch;
    refusedRun(scratch, scratch.path("none.scene.json"), "none.scene.json: no such file");
    refusedRun(scratch, scratch.path(""), "expected a scene file, found a folder");
    refusedRun(scratch, scratch.write("text.scene.json", "scene of leaves\n"), "text.scene.json:1:1: ");
    refusedRun(scratch, scratch.write("cut.scene.json", "{\"format\": \"shoal-scene-1\",\n"),
               "cut.scene.json:2:1: ");
    refusedRun(scratch, scratch.write("empty.scene.json", ""), "empty.scene.json:1:1: ");
    refusedRun(scratch, scratch.write("bytes.scene.json", "{\"name\": \"\xff\"}"), "bytes.scene.json:1:");
    refusedRun(scratch, sourceFile("molecules/quad.json"), "quad.json:2:");
    refusal({"check", scratch.path("none.json")}, "none.json: no such file");
}

TEST_CASE("mistakes in a scene are located", "[cli]") {
    const Change changes[] = {
        {"\"gravity\"", "\"gravty\"", "\"gravty\"", "did you mean \"gravity\"?"},
        {"\"restitution\": 0.9", "\"restition\": 0.9", "\"restition\"", "did you mean \"restitution\"?"},
        {"\"frameRate\": 30", "\"frameRate\": \"30\"", "\"30\"", "expected a number"},
        {"\"frameRate\": 30", "\"frameRate\": 0", "0,\n  \"gravity\"", "from 1"},
        {"\"gravity\": [0, -9.81, 0]", "\"gravity\": [0, NaN, 0]", "NaN", ""},
        {"\"gravity\": [0, -9.81, 0]", "\"gravity\": [0, 1e999, 0]", "1e999", ""},
        {"\"gravity\": [0, -9.81, 0]", "\"gravity\": [0, -9.81]", "[0, -9.81]", "3"},
        {"\"substeps\": 12", "\"substeps\": 1.5", "1.5", "whole number"},
        {"\"method\": \"euler\"", "\"method\": \"eulr\"", "\"eulr\"", "did you mean \"euler\"?"},
        {"\"type\": \"gust\"", "\"type\": \"gusts\"", "\"gusts\"", "did you mean \"gust\"?"},
        {"\"count\": 3", "\"count\": 0", "0,\n     \"place\"", "1"},
        {"\"count\": 3", "\"count\": -1", "-1,\n     \"place\"", "1"},
        {"\"count\": 3", "\"count\": 2000000000", "2000000000", "from 1 to 1073741824"},
        {"\"model\": \"hill\", \"select\"", "\"model\": \"hil\", \"select\"", "\"hil\"",
         "did you mean \"hill\"?"},
        {"\"object\": \"post\"", "\"object\": \"pots\"", "", "pots"},
        {"\"substeps\": 12", "\"substeps\": 1", "{\"method\"", "use at least "},
        {"\"format\": \"shoal-scene-1\"", "\"format\": \"shoal-scene-9\"", "\"shoal-scene-9\"",
         "shoal-scene-1"},
        {"\"friction\": 0,", "\"friction\": 0, \"friction\": 1,", "", "friction"},
    };
    for (const Change& change : changes) {
        const Scratch scratch;
        const std::string text = replaced(smallScene, change.from, change.to);
        const std::string scene = writeSmallScene(scratch, text);
        const std::string message = refusedRun(scratch, scene, change.message);
        INFO(message);
        CHECK_THAT(message, Catch::Contains("all.scene.json:"));
        if (*change.at)
            CHECK_THAT(message, Catch::Contains("all.scene.json:" + placeOf(text, change.at) + ": "));
    }
}

TEST_CASE("mistakes in a molecule are located in its own file", "[cli]") {
    const Change changes[] = {
        {"\"a\": 1, \"b\": 2", "\"a\": 1, \"b\": 3", "3}", ""},
        {"\"triangles\": [[0, 1, 2]]", "\"triangles\": [[0, 1, 7]]", "", "7"},
        {"\"mass\": 0.01", "\"mass\": -1", "-1,", "from 1e-12"},
        {"\"pinned\": true", "\"pined\": true", "\"pined\"", "did you mean \"pinned\"?"},
        {"\"stiffness\": 20", "\"stiffness\": 1e999", "1e999", ""},
        {"\"vertices\": [", "\"vertices\": [7, ", "7", "expected an object"},
    };
    for (const Change& change : changes) {
        const Scratch scratch;
        const std::string scene = writeSmallScene(scratch);
        const std::string text = replaced(smallMolecule, change.from, change.to);
        scratch.write("blade.json", text);
        const std::string message = refusedRun(scratch, scene, change.message);
        INFO(message);
        CHECK_THAT(message, Catch::Contains("blade.json:"));
        if (*change.at) CHECK_THAT(message, Catch::Contains("blade.json:" + placeOf(text, change.at) + ": "));
        refusal({"check", scratch.path("blade.json")}, "blade.json:");
    }
}

TEST_CASE("mistakes in a vector field are located in its own file", "[cli]") {
    const std::pair<const char*, const char*> fields[] = {
        {"2, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n0.5, 0, 0,\n", "6"},               // half of the vectors
        {"2, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n0.5, 0, 0,\n1, 2, 3,\n4,\n", ""},  // too many
        {"2, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n0.5, zero, 0,\n1, 2, 3,\n", ".fga:4:6: "},
        {"2, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n0.5, nan, 0,\n1, 2, 3,\n", ".fga:4:6: "},
        {"99999, 99999, 99999,\n-1, -1, -1,\n1, 1, 1,\n", ""},
        {"0, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n", ".fga:1:1: "},
        {"", ""},
    };
    for (const auto& [text, part] : fields) {
        const Scratch scratch;
        const std::string scene = writeSmallScene(scratch);
        scratch.write("wind.fga", text);
        INFO(text);
        CHECK_THAT(refusedRun(scratch, scene, part), Catch::Contains("wind.fga:"));
    }
    const Scratch scratch;
    const std::string scene = writeSmallScene(scratch);
    std::filesystem::remove(scratch.path("wind.fga"));
    refusedRun(scratch, scene, "no such file: ");
}

TEST_CASE("models without triangles, or that are none", "[cli]") {
    const Scratch scratch;
    const std::string scene = writeSmallScene(scratch);
    scratch.write("hill.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\n");
    refusedRun(scratch, scene, "model \"hill\" has no triangles");
    scratch.write("hill.obj", "\x7f\x45\x4c\x46 no mesh\n");
    refusedRun(scratch, scene, "hill.obj: ");
    std::filesystem::remove(scratch.path("hill.obj"));
    refusedRun(scratch, scene, "no such file: ");
}

TEST_CASE("a height field's image that is none", "[cli]") {
    const Scratch scratch;
    const std::string scene = scratch.write(
        "small.scene.json",
        R"({"format": "shoal-scene-1",
  "colliders": [{"type": "heightField", "image": "heights.png", "low": [0, 0], "high": [1, 1], "heights": [0, 1]}],
  "groups": [{"molecule": ")" +
            sourceFile("molecules/quad.json") +
            R"(", "count": 1, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]})");
    refusedRun(scratch, scene, "no such file: ");
    scratch.write("heights.png", "no picture");
    refusedRun(scratch, scene, "heights.png: ");
    // the head of a picture, cut off
    scratch.write("heights.png", readFile(sourceFile("models/tree/terrain-height.png")).substr(0, 200));
    refusedRun(scratch, scene, "heights.png: ");
}

TEST_CASE("a step that is too long names the substeps that would do", "[cli]") {
    const std::string message =
        refusal({"run", squaresScene(), "--headless", "--frames", "1", "--dt", "0.1", "--solver", "leapfrog"},
                "use at least 9 substeps");
    CHECK_THAT(message, Catch::Contains("squares.scene.json:"));
    CHECK(runShoal({"run", squaresScene(), "--headless", "--frames", "1", "--dt", "0.1", "--solver",
                    "leapfrog", "--substeps", "9", "--json"})
              .code == 0);
}

TEST_CASE("more molecules than can be had say how many fit", "[cli]") {
    refusal({"run", squaresScene(), "--headless", "--count", "1073741825"},
            "expected a whole number from 1 to 1073741824");
    refusal({"explain", squaresScene(), "--count", "2147483647"},
            "expected a whole number from 1 to 1073741824");
    const Scratch scratch;  // 9 vertices each are too many before that
    const std::string scene = scratch.write(
        "many.scene.json", R"({"format": "shoal-scene-1", "groups": [{"count": 900000000, "molecule": ")" +
                               sourceFile("molecules/leaf.json") + R"(",
        "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]})");
    CHECK_THAT(refusal({"explain", scene}, "at most 238609294 such molecules fit"),
               Catch::Contains("many.scene.json:1:"));
    // before anything is measured
    refusal({"explain", scene, "--error", "1e-3"}, "at most 238609294 such molecules fit");
    refusal({"measure", scene}, "at most 238609294 such molecules fit");
}

#ifndef __SANITIZE_ADDRESS__
TEST_CASE("what does not fit into memory is named, with where and how much", "[cli]") {
    const Scratch scratch;
    const std::string scene = scratch.write(
        "count.scene.json", R"({"format": "shoal-scene-1", "groups": [{"name": "many", "molecule": ")" +
                                sourceFile("molecules/quad.json") +
                                R"(", "count": 100000000, "place": {"on": "volume",
 "box": {"low": [-1, 0, -1], "high": [1, 2, 1]}}}]})");
    const std::string message =
        refusal({"check", scene},
                "not enough memory for 100000000 molecules of 4 vertices in \"many\", which take about 11444",
                {.addressSpace = size_t{4} << 30});
    CHECK_THAT(message, Catch::Contains("count.scene.json:1:"));
}
#endif
