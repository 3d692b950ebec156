// The two paths as the command shows them: which one runs, its options, its kernels, its cache.
#include <filesystem>
#include <set>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const Surroundings on33{
    .environment = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}, {"MESA_GLSL_VERSION_OVERRIDE", "330"}}};

Words runWords(const Words& more = {}) {
    Words words{"run", squaresScene(), "--headless", "--frames", "3", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

JsonValue report(const Words& more = {}, const Surroundings& surroundings = {}) {
    const Outcome outcome = runShoal(runWords(more), surroundings);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.messages().empty());
    return outcome.json();
}

std::string hashOf(const JsonValue& run) {
    return member(run, "hash").text;
}

// A run that must succeed with one warning about the cache in `folder`; returns the warning.
std::string warningWithCache(const std::string& folder) {
    const Outcome outcome = runShoal(runWords(), {.environment = {{"SHOAL_CACHE", folder}}});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(hashOf(outcome.json()) == hashOf(report()));
    REQUIRE(outcome.messages().size() == 1);
    CHECK_THAT(outcome.messages()[0], Catch::Contains("shoal: warning: "));
    return outcome.messages()[0];
}

}  // namespace

TEST_CASE("a run names its path", "[cli]") {
    const JsonValue fused = report();
    CHECK(member(fused, "path").text == "fused");
    CHECK(hashOf(report({"--path", "fused"})) == hashOf(fused));
    CHECK(hashOf(report({"--path", "auto"})) == hashOf(fused));
    const JsonValue pingPong = report({"--path", "ping-pong"});
    CHECK(member(pingPong, "path").text == "ping-pong");
    CHECK(member(pingPong, "stateBytes").number != member(fused, "stateBytes").number);

    const JsonValue inPlace = report({"--in-place"});
    CHECK(hashOf(inPlace) == hashOf(fused));
    CHECK(member(inPlace, "stateBytes").number < member(fused, "stateBytes").number);
    CHECK(member(report({"--lanes", "vertex"}), "path").text == "fused");
    CHECK(hashOf(report({"--lanes", "molecule"})) == hashOf(fused));
}

TEST_CASE("below OpenGL 4.3 the fused path runs in fragments, to the same bits", "[cli]") {
    const JsonValue run = report({}, on33);
    CHECK(member(run, "path").text == "fragments");
    CHECK(hashOf(run) == hashOf(report()));
    CHECK(hashOf(report({"--path", "fused"}, on33)) == hashOf(run));
    CHECK(hashOf(report({"--path", "fragments"})) == hashOf(run));
    CHECK(member(report({"--field-sampling", "vertexFrame"}, on33), "path").text == "fragments");
    const auto fire = [](const Surroundings& where) {
        const Scratch scratch;
        const Outcome outcome = runShoal({"run", sourceFile("models/fire/fire.scene.json"), "--headless",
                                          "--frames", "30", "--export", scratch.path("x.csv"), "--json"},
                                         where);
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return outcome.json();
    };
    const JsonValue below = fire(on33);
    CHECK(member(below, "path").text == "fragments");
    CHECK(hashOf(below) == hashOf(fire({})));
}

TEST_CASE("fields are read as often as is asked", "[cli]") {
    std::set<std::string> hashes;
    for (const char* sampling : {"vertexSubstep", "vertexFrame", "moleculeFrame"}) {
        hashes.insert(hashOf(report({"--field-sampling", sampling})));
        const JsonValue plan =
            runShoal({"explain", squaresScene(), "--json", "--field-sampling", sampling}).json();
        CHECK(member(plan, "fieldSampling").text == sampling);
    }
    CHECK(hashes.size() == 3);
    CHECK(hashes.count(hashOf(report())) == 1);
}

TEST_CASE("words that no path knows are refused", "[cli]") {
    refusal(runWords({"--path", "fusd"}), "unknown path \"fusd\" (did you mean \"fused\"?)");
    refusal(runWords({"--path", "pingpong"}), "did you mean \"ping-pong\"?");
    refusal(runWords({"--lanes", "vertices"}), "unknown lanes \"vertices\"");
    refusal(runWords({"--field-sampling", "vertexframe"}), "did you mean \"vertexFrame\"?");
    refusal(runWords({"--path", "ping-pong", "--field-sampling", "moleculeFrame"}), "needs the fused path");
    refusal({"explain", squaresScene(), "--path", "x"}, "unknown path \"x\"");
    refusal({"explain", squaresScene(), "--path", "ping-pong", "--shader"}, "--shader");
}

TEST_CASE("explain prints the kernels, in which no slider's value occurs", "[cli]") {
    const auto kernels = [](const Words& more) {
        Words words{"explain", squaresScene(), "--shader"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = runShoal(words);
        CHECK(outcome.code == 0);
        return outcome.out;
    };
    const std::string text = kernels({});
    for (const char* part :
         {"#version 430 core", "void springForces(float time)", "void main()", "gustFromTile("})
        CHECK_THAT(text, Catch::Contains(part));
    CHECK(text.find("9.81") == std::string::npos);
    CHECK(kernels({"--substeps", "9", "--dt", "0.011", "--count", "77", "--seed", "3"}) == text);
    CHECK(kernels({"--solver", "euler"}) != text);
    CHECK_THAT(kernels({"--lanes", "vertex"}), Catch::Contains("readonly buffer Topology"));
    CHECK_THAT(kernels({"--path", "fragments"}),
               Catch::Contains("#version 330 core") && Catch::Contains("out vec4 target0;"));
}

TEST_CASE("programs are kept for the next start", "[cli]") {
    const Scratch scratch;
    const Surroundings cached{.environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
    const std::string first = hashOf(report({}, cached));
    const std::vector<std::string> files = filesIn(scratch.path("cache"));
    if (files.empty()) {
        WARN("skipped: this driver hands out no program binaries");
        return;
    }
    CHECK(hashOf(report({}, cached)) == first);
    CHECK(filesIn(scratch.path("cache")) == files);
    CHECK(hashOf(report({}, {.environment = {{"SHOAL_CACHE", ""}}})) == first);
}

TEST_CASE("a cache that is damaged or cannot be written is a warning and no more", "[cli]") {
    const Scratch scratch;
    const std::string file = scratch.write("file", "no folder");
    CHECK_THAT(warningWithCache(file + "/cache"), Catch::Contains("programs are compiled at every start"));

    const std::string cache = scratch.path("cache");
    report({}, {.environment = {{"SHOAL_CACHE", cache}}});
    std::vector<std::string> programs = filesIn(cache);
    std::erase_if(programs, [](const std::string& name) { return !name.ends_with(".shoal-program"); });
    REQUIRE(!programs.empty());
    scratch.write("cache/" + programs[0], "shoalprg, but nothing behind it that makes sense");
    CHECK_THAT(warningWithCache(cache), Catch::Contains(programs[0]) && Catch::Contains("compiled anew"));
    report({}, {.environment = {{"SHOAL_CACHE", cache}}});  // and repaired
}
