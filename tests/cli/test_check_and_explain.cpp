// `check` over everything that is shipped; `explain`: a scene pays for what it holds, and for nothing else.
#include <algorithm>
#include <filesystem>
#include <set>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words shippedFiles(const std::string& folder, const std::string& ending) {
    Words found;
    for (const std::string& file : filesIn(sourceFile(folder)))
        if (file.ends_with(ending) && file.find(".schema.") == std::string::npos)
            found.push_back(sourceFile(folder + "/" + file));
    return found;
}

Words both() {
    Words files = shippedFiles("molecules", ".json"), scenes = shippedFiles("models", ".scene.json");
    REQUIRE(files.size() >= 7);
    REQUIRE(scenes.size() >= 2);
    files.insert(files.end(), scenes.begin(), scenes.end());
    return files;
}

constexpr const char* vertices = R"("vertices": [{"position": [0, 0, 0], "mass": 0.01, "pinned": true},
    {"position": [0.2, 0, 0], "mass": 0.01}, {"position": [0, 0.2, 0], "mass": 0.01}])";
constexpr const char* springs =
    R"(, "springs": [{"a": 0, "b": 1, "stiffness": 5}, {"a": 1, "b": 2, "stiffness": 5},
    {"a": 0, "b": 2, "stiffness": 5}])";
constexpr const char* triangles = R"(, "triangles": [[0, 1, 2]])";

// A scene of three molecules, pinned at one vertex unless the group says otherwise.
std::string writeScene(const Scratch& scratch, const std::string& molecule, const std::string& group,
                       const std::string& scene) {
    scratch.write("part.json", R"({"format": "shoal-molecule-1", "name": "part", )" + molecule + "}");
    return scratch.write("small.scene.json",
                         R"({"format": "shoal-scene-1", )" + scene +
                             R"("groups": [{"name": "parts", "molecule": "part.json", "count": 3,
        "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}})" +
                             group + "}]}");
}

// The passes of the only group on the ping-pong path, as "name" or "name!" for those of every substep.
std::multiset<std::string> passes(const std::string& scene, const Words& options = {}) {
    Words words{"explain", scene, "--path", "ping-pong", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = runShoal(words);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    for (const char* key : {"scene", "frameRate", "substeps", "stateBytes", "tableBytes"})
        member(report, key);
    const std::vector<JsonValue>& groups = member(report, "groups").items;
    REQUIRE(groups.size() == 1);
    CHECK(member(groups[0], "name").text == "parts");
    CHECK(member(groups[0], "molecules").number == 3);
    CHECK(member(groups[0], "vertices").number == 3);
    CHECK_FALSE(member(groups[0], "solver").text.empty());
    std::multiset<std::string> found;
    for (const JsonValue& pass : member(groups[0], "passes").items) {
        CHECK_FALSE(member(pass, "why").text.empty());
        const bool often = member(pass, "when").text == "every substep";
        found.insert(member(pass, "pass").text + (often ? "!" : ""));
    }
    return found;
}

using Set = std::multiset<std::string>;

}  // namespace

TEST_CASE("everything shipped passes its check", "[cli]") {
    Words words = both();
    const size_t count = words.size();
    words.insert(words.begin(), "check");
    const Outcome plain = runShoal(words);
    INFO(plain.err);
    CHECK(plain.code == 0);
    CHECK(plain.err.find("shoal:") ==
          std::string::npos);  // a distance field that is baked tells how far it is

    words.emplace_back("--json");
    const Outcome outcome = runShoal(words);
    CHECK(outcome.code == 0);
    const JsonValue report = outcome.json();
    REQUIRE(report.items.size() == count);
    for (const JsonValue& entry : report.items) {
        const std::string file = member(entry, "file").text, kind = member(entry, "kind").text;
        INFO(file);
        CHECK(member(entry, "ok").boolean);
        CHECK(kind == (file.ends_with(".scene.json") ? "scene" : "molecule"));
        CHECK(member(entry, "warnings").kind == JsonValue::Kind::array);
        const JsonValue& facts = member(entry, kind);
        CHECK_FALSE(member(facts, "name").text.empty());
        if (kind == "scene") {
            CHECK(member(facts, "groups").number >= 1);
            CHECK(member(facts, "molecules").number >= 1);
            continue;
        }
        CHECK(member(facts, "vertices").number >= 1);
        CHECK(member(facts, "totalMass").number > 0);
        CHECK(member(facts, "restEnergy").number == Approx(0).margin(1e-12));
        for (const char* key : {"triangles", "zeroModes", "lowestFrequency", "highestFrequency"})
            member(facts, key);
        if (member(facts, "springs").number > 0) CHECK(member(facts, "stableStepLeapfrog").number > 0);
    }
}

TEST_CASE("one bad file among good ones fails the check and is named", "[cli]") {
    const Scratch scratch;
    const std::string bad =
        scratch.write("bad.json", "{\"format\": \"shoal-molecule-1\",\n \"vertices\": {}}");
    const Outcome outcome = runShoal({"check", squaresScene(), bad, "--json"});
    CHECK(outcome.code == 1);
    const JsonValue report = outcome.json();
    REQUIRE(report.items.size() == 2);
    CHECK(member(report.items[0], "ok").boolean);
    CHECK_FALSE(member(report.items[1], "ok").boolean);
    CHECK_THAT(member(report.items[1], "error").text, Catch::Contains("bad.json:2:"));
    const Outcome plain = runShoal({"check", bad, squaresScene()});
    CHECK(plain.code == 1);
    CHECK(plain.messages().size() == 1);
    CHECK_THAT(plain.out, Catch::Contains("scene \"squares\""));  // the others are still checked
}

TEST_CASE("a warning is told and does not fail", "[cli]") {
    const Outcome outcome = runShoal({"check", sourceFile("molecules/quad.json")});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("warning: "));
    CHECK_THAT(outcome.out, Catch::Contains("without any stiffness"));
}

TEST_CASE("what a model's file loses is an error of every command that reads it, but with --lenient",
          "[cli][model]") {
    const Scratch scratch;
    std::string triangles;
    for (const char* corners : {"vertex 6.5e6 0 0\nvertex 6500001 0 0\nvertex 6.5e6 1 0\n",
                                "vertex 6500001 0 0\nvertex 6500001 1 0\nvertex 6.5e6 1 0\n"})
        triangles += concat("facet normal 0 0 1\nouter loop\n", corners, "endloop\nendfacet\n");
    const std::string far = scratch.write("far.stl", concat("solid a\n", triangles, "endsolid a\n"));
    const std::string scene = scratch.write(
        "far.scene.json", R"({"format": "shoal-scene-1", "models": [{"name": "far", "file": "far.stl"}],
            "groups": [{"particle": {"mass": 1, "shape": "quads", "size": 0.1, "blend": "none"},
                "place": {"on": "list", "items": [{}]}}]})");
    const std::string molecule = scratch.path("far.json");
    const std::vector<Words> commands = {{"check", scene},
                                         {"explain", scene},
                                         {"run", scene, "--headless", "--frames", "1"},
                                         {"export", scene, "--glb", scratch.path("far.glb")},
                                         {"molecule", "from-mesh", far, "-o", molecule}};
    for (Words words : commands) {
        INFO(words[0]);
        const Outcome refused = runShoal(words);
        CHECK(refused.code == 1);
        CHECK_THAT(refused.err, Catch::Contains("rounded by up to") && Catch::Contains("--lenient reads it"));
        words.emplace_back("--lenient");
        const Outcome read = runShoal(words);
        INFO(read.err);
        CHECK(read.code == 0);
        CHECK_THAT(read.out + read.err, Catch::Contains("rounded by up to"));
    }
}

TEST_CASE("the smallest scene that ships warns of nothing", "[cli]") {
    const Outcome outcome = runShoal({"check", squaresScene()});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, !Catch::Contains("warning"));
}

TEST_CASE("check warns of how a scene starts", "[cli]") {
    const Scratch scratch;
    const auto check = [&](const std::string& keys, const std::string& place, const std::string& group = "") {
        scratch.write(
            "dot.json",
            R"({"format": "shoal-molecule-1", "name": "dot", "vertices": [{"position": [0, 0, 0], "mass": 1}]})");
        const std::string scene =
            scratch.write("s.scene.json", concat(R"({"format": "shoal-scene-1", )", keys,
                                                 R"("groups": [{"molecule": "dot.json", )", group,
                                                 R"("place": {"on": "list", "items": [)", place, "]}}]}"));
        const Outcome outcome = runShoal({"check", scene});
        CHECK(outcome.code == 0);
        return outcome.out;
    };
    const std::string there = R"({"position": [0, 1, 0]})", below = there + R"(, {"position": [0, -0.5, 0]})";
    const std::string plane = R"("colliders": [{"type": "plane"}], )";
    CHECK_THAT(check("", there), !Catch::Contains("warning"));
    CHECK_THAT(check(plane, there), !Catch::Contains("warning"));
    CHECK_THAT(check(plane, below), Catch::Contains("1 of 2 molecules of \"dot\" start inside the plane"));
    CHECK_THAT(check(plane, below, R"("collide": false, )"), !Catch::Contains("warning"));
    CHECK_THAT(check(R"("camera": {"eye": [0, 1, 5], "target": [0, 1, 9]}, )", there),
               Catch::Contains("the camera sees no molecule"));
    CHECK_THAT(check(R"("light": {"intensity": 0}, )", there), !Catch::Contains("warning"));
    CHECK_THAT(check(R"("light": {"intensity": 0}, "sky": {"intensity": 0}, )", there),
               Catch::Contains("nothing lights the scene"));
    CHECK_THAT(check(R"("fields": [{"type": "uniform", "velocity": [1, 0, 0]}], )", there),
               Catch::Contains("has no \"drag\", through which fields would move it"));
    CHECK_THAT(check(R"("forces": [{"type": "wind", "velocity": [1, 0, 0]}], )", there),
               Catch::Contains("has no \"drag\", through which wind would move it"));
    CHECK_THAT(check(R"("forces": [{"type": "wind", "velocity": [1, 0, 0]}], )", there, R"("drag": 1, )"),
               !Catch::Contains("warning"));
}

TEST_CASE("check warns of colliders that nothing can reach", "[cli][check]") {
    const Scratch scratch;
    scratch.write("dot.json",
                  R"({"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0], "mass": 1}]})");
    const auto check = [&](const std::string& collider, const std::string& group) {
        const std::string scene = scratch.write(
            "s.scene.json",
            concat(R"({"format": "shoal-scene-1", "colliders": [{"name": "floor", "type": "plane"}, )",
                   collider, R"(], "groups": [{"molecule": "dot.json", )", group,
                   R"("place": {"on": "list", "items": [{"position": [0, 1, 0]}]}}]})"));
        const Outcome outcome = runShoal({"check", scene});
        CHECK(outcome.code == 0);
        return outcome.out;
    };
    CHECK_THAT(check(R"({"type": "sphere", "center": [0, -0.9, 0], "radius": 1})", ""),
               !Catch::Contains("reach"));
    CHECK_THAT(check(R"({"type": "sphere", "center": [0, -1.1, 0], "radius": 1})", ""),
               Catch::Contains("nothing can reach the sphere: it lies wholly behind \"floor\""));
    CHECK_THAT(check(R"({"type": "box", "center": [0, -0.6, 0], "size": [1, 1, 1]})", ""),
               Catch::Contains("wholly behind"));
    CHECK_THAT(
        check(
            R"({"type": "box", "center": [0, -0.6, 0], "size": [1, 1, 1], "rotation": {"axis": [0, 0, 1], "angle": 0.785}})",
            ""),
        !Catch::Contains("reach"));
    CHECK_THAT(check(R"({"type": "sphere", "center": [0, 1, 0], "radius": 1, "draw": false})",
                     R"("collide": false, )"),
               Catch::Contains("\"collide\" of all groups is false"));
}

TEST_CASE("check warns of emitters that never emit and of more triangles than can be seen", "[cli][check]") {
    const Scratch scratch;
    scratch.write(
        "dot.json",
        R"({"format": "shoal-molecule-1", "name": "dot", "vertices": [{"position": [0, 0, 0], "mass": 1}]})");
    const auto check = [&](const std::string& emitter, const std::string& firstLife) {
        const std::string scene =
            scratch.write("s.scene.json", concat(R"({"format": "shoal-scene-1", "groups": [
                {"name": "first", "molecule": "dot.json", "life": {"capacity": 9)",
                                                 firstLife, R"(}, "emitters": [)", emitter, R"(]},
                {"name": "second", "molecule": "dot.json", "life": {"capacity": 9},
                 "emitters": [{"from": "death", "of": "first"}]}],
                "camera": {"eye": [0, 0, 3], "target": [0, 0, 0]}})"));
        const Outcome outcome = runShoal({"check", scene});
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        return outcome.out;
    };
    const std::string mortal = R"(, "span": 1)";
    const std::string steady = R"({"from": "point", "position": [0, 0, 0], "rate": )";
    CHECK_THAT(check(steady + "5}", mortal), !Catch::Contains("warning"));
    CHECK_THAT(check(steady + "5}", ""), Catch::Contains("never emits: nothing of \"first\" dies"));
    CHECK_THAT(check(steady + "0}", mortal), Catch::Contains("never emits: its \"rate\" is 0"));

    const std::string minnow = sourceFile("molecules/minnow.json");
    for (const auto& [count, warns] : {std::pair(1000, false), std::pair(1100, true)}) {
        const std::string scene = scratch.write(
            "many.scene.json",
            concat(R"({"format": "shoal-scene-1", "groups": [{"name": "minnows", "molecule": ")", minnow,
                   R"(", "count": )", count,
                   R"(, "place": {"on": "volume", "box": {"low": [-1, -1, -1], "high": [1, 1, 1]}}}]})"));
        const Outcome outcome = runShoal({"check", scene});
        CHECK(outcome.code == 0);
        CHECK((outcome.out.find("the skins of \"minnows\" have 2 million triangles") != std::string::npos) ==
              warns);
    }
}

TEST_CASE("a scene has the passes that it needs", "[cli]") {
    const Scratch scratch;
    const std::string whole = std::string(vertices) + springs + triangles;
    const std::string drag = R"(, "drag": 1)", plane = R"("colliders": [{"type": "plane"}], )",
                      wind = R"("fields": [{"type": "uniform", "velocity": [1, 0, 0]}], )";
    SECTION("held by its pins, with springs") {
        const std::string scene = writeScene(scratch, whole, drag, wind);
        CHECK(passes(scene) == Set{"restore", "advect!", "restore!", "normals", "watch"});
        CHECK(passes(scene, {"--solver", "euler"}) == Set{"restore!", "advect!", "normals", "watch"});
    }
    SECTION("colliders") {
        CHECK(passes(writeScene(scratch, whole, drag, plane)).contains("collide!"));
        CHECK_FALSE(passes(writeScene(scratch, whole, R"(, "collide": false)", plane)).contains("collide!"));
    }
    SECTION("without springs nothing restores") {
        CHECK(passes(writeScene(scratch, std::string(vertices) + triangles, drag, wind)) ==
              Set{"advect!", "normals", "watch"});
    }
    SECTION("without triangles there are no normals") {
        CHECK(passes(writeScene(scratch, std::string(vertices) + springs, drag, wind)) ==
              Set{"restore", "advect!", "restore!", "watch"});
    }
    SECTION("records run for what flies or may come to fly") {
        CHECK(passes(writeScene(scratch, whole, R"(, "held": false)", "")).contains("records"));
        CHECK(passes(writeScene(scratch, whole, R"(, "release": {"rate": 0.5})", "")).contains("records"));
        CHECK_FALSE(passes(writeScene(scratch, whole, "", "")).contains("records"));
    }
    SECTION("drag across and along needs normals in the step") {
        CHECK(passes(writeScene(scratch, whole, R"(, "drag": {"normal": 5, "tangent": 1})", ""))
                  .contains("normals!"));
    }
}

TEST_CASE("explain says what was left out, and why", "[cli]") {
    const Scratch scratch;
    const std::string wind = R"("fields": [{"type": "uniform", "velocity": [1, 0, 0]}], )";
    const std::string scene = writeScene(scratch, vertices, "", wind);
    const Outcome passes = runShoal({"explain", scene, "--path", "ping-pong"});
    CHECK(passes.code == 0);
    for (const char* part : {"no springs: no restore", "no colliders: no collide",
                             "no drag: no field is read", "no triangles: no normals", "no records"})
        CHECK_THAT(passes.out, Catch::Contains(part));
    CHECK_THAT(passes.out, !Catch::Contains("every substep        the"));
    // a field that nothing feels is worth a word
    CHECK_THAT(passes.out, !Catch::Contains("dragged by the fields"));

    const Outcome fused = runShoal({"explain", scene, "--path", "fused"});
    CHECK(fused.code == 0);
    for (const char* part : {"fused    once a frame         motion", "no springs, no colliders",
                             "no drag: no field is read", "no triangles: no normals", "anchors stay"})
        CHECK_THAT(fused.out, Catch::Contains(part));
}

TEST_CASE("explain names every pass of a frame, how often it runs, and what it reads and writes", "[cli]") {
    const Outcome outcome =
        runShoal({"explain", sourceFile("models/jar/sweets.scene.json"), "--passes", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    const std::vector<JsonValue>& rows = member(member(report, "frame"), "passes").items;
    // how often a pass runs that writes this array in this stage
    const auto timesOf = [&](const char* stage, const char* pass, const char* array) {
        double times = 0;
        for (const JsonValue& row : rows) {
            const std::vector<JsonValue>& names = member(row, "writes").items;
            const bool writes = std::any_of(names.begin(), names.end(),
                                            [&](const JsonValue& name) { return name.text == array; });
            if (member(row, "stage").text == stage && member(row, "pass").text == pass && writes)
                times += member(row, "times").number;
        }
        return times;
    };
    constexpr int steps = 8, iterations = 8, groups = 4;
    CHECK(timesOf("fused", "fused step of cherry", "newState") == groups * steps);  // of one kernel
    CHECK(timesOf("contact response", "contact solve_first", "earlierImpulses") == steps);
    CHECK(timesOf("contact response", "contact solve", "earlierImpulses") == steps * (iterations - 1));
    CHECK(timesOf("contact response", "contact store", "keptImpulses") == steps);
    CHECK(timesOf("contact response", "contact store", "impulses") == 0);
}

TEST_CASE("the stages of run --timings are those of explain --passes", "[cli]") {
    const Scratch scratch;
    const auto stagesOf = [](const std::vector<JsonValue>& rows) {
        std::set<std::string> out;
        for (const JsonValue& row : rows)
            out.insert(member(row, "stage").text);
        return out;
    };
    for (const char* scene : {"tree/leaves", "fire/fire", "reef/school", "jar/sweets"}) {
        for (const char* path : {"fused", "fragments"}) {
            INFO(scene << ", " << path);
            const std::string file = sourceFile(concat("models/", scene, ".scene.json"));
            const Outcome passes = runShoal({"explain", file, "--passes", "--json", "--path", path});
            REQUIRE(passes.code == 0);
            const Outcome timed =
                runShoal({"run", file, "--headless", "--frames", "2", "--size", "64x36", "--timings",
                          "--json", "--capture", scratch.path("pictures"), "--path", path});
            INFO(timed.err);
            REQUIRE(timed.code == 0);
            const std::set<std::string> stages = stagesOf(member(timed.json(), "stages").items);
            CHECK(stages.size() > 3);
            CHECK(stages == stagesOf(member(member(passes.json(), "frame"), "passes").items));
        }
    }
}

TEST_CASE("explain takes the same overrides as run", "[cli]") {
    const JsonValue report = runShoal({"explain", squaresScene(), "--json", "--count", "2000", "--substeps",
                                       "7", "--dt", "0.02", "--solver", "euler"})
                                 .json();
    CHECK(member(report, "substeps").number == 7);
    CHECK(member(report, "frameRate").number == Approx(50));
    const JsonValue& group = member(report, "groups").items[0];
    CHECK(member(group, "solver").text == "euler");
    CHECK(member(group, "molecules").number == 2000);
    CHECK(member(member(group, "lanes"), "gpu").text == "molecule");
    const Outcome asked = runShoal({"explain", squaresScene(), "--lanes", "vertex"});
    CHECK_THAT(asked.out, Catch::Contains("on a CPU rasteriser a lane a vertex, as asked"));
    refusal({"explain", squaresScene(), "--lanes", "vertex", "--solver", "xpbd", "--shader"},
            "leave out --lanes vertex");
}

TEST_CASE("a count also says how many places there are where molecules are born", "[cli]") {
    // The fountain starts empty, the snowfall with all its flakes in the air.
    for (const char* file : {"models/fountain/fountain.scene.json", "models/winter/snowfall.scene.json"}) {
        INFO(file);
        const Outcome outcome = runShoal({"explain", sourceFile(file), "--json", "--count", "50"});
        REQUIRE(outcome.code == 0);
        const std::vector<JsonValue> groups = member(outcome.json(), "groups").items;
        REQUIRE(groups.size() == 2);
        for (const JsonValue& group : groups)
            CHECK(member(group, "molecules").number == 50);
    }
}
