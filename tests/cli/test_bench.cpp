// `shoal bench`: what it reports, and what it refuses.
#include <filesystem>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const Words fast = {"bench", "--quick", "--only", "1,024 quads: ", "--seconds", "0.05"};

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace

TEST_CASE("bench reports every case as JSON", "[cli]") {
    const Outcome outcome = runShoal(with(fast, {"--json"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::Contains("This takes about "));
    const JsonValue report = outcome.json();
    CHECK_FALSE(member(member(report, "machine"), "processor").text.empty());
    CHECK(member(member(report, "machine"), "cores").number >= 1);
    CHECK_FALSE(member(member(report, "context"), "renderer").text.empty());
    for (const char* key : {"version", "quick", "secondsAGroup", "seconds", "errors", "startUp", "passTimes"})
        member(report, key);
    const std::vector<JsonValue>& cases = member(report, "cases").items;
    REQUIRE(cases.size() >= 8);
    for (const JsonValue& one : cases) {
        CHECK(member(one, "group").text == "1,024 quads");
        CHECK(member(one, "count").number == 1024);
        CAPTURE(member(one, "case").text);
        if (one.find("leftOut")) continue;
        CHECK(member(one, "samples").number >= 3);
        CHECK(member(one, "minSeconds").number > 0);
        CHECK(member(one, "medianSeconds").number >= member(one, "minSeconds").number);
        CHECK(member(one, "busStateBytesPerFrame").number == 0);
        for (const char* key : {"subject", "molecule", "framesPerSample", "nanosecondsPerMolecule",
                                "overAvx512", "overAvx2", "fasterThanPingPong", "stateBytesPerMolecule",
                                "movedBytesPerFrame", "bytesPerSecond", "shareOfCopy"})
            member(one, key);
        if (member(one, "subject").text == "ping-pong" || member(one, "subject").text == "fused")
            for (const char* key :
                 {"solver", "substeps", "wind", "fieldSampling", "lanes", "inPlace", "drawn"})
                member(one, key);
    }
    REQUIRE_FALSE(member(report, "targets").items.empty());
    for (const JsonValue& target : member(report, "targets").items) {
        CHECK_FALSE(member(target, "target").text.empty());
        member(target, "measured");
        CHECK((target.find("atLeast") != nullptr) != (target.find("atMost") != nullptr));
    }
}

TEST_CASE("bench prints a table", "[cli]") {
    const Outcome outcome =
        runShoal({"bench", "--quick", "--only", "1,024 quads: ping-pong", "--seconds", "0.05"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("1,024 quads") && Catch::Contains("median ms") &&
                                Catch::Contains("ping-pong"));
}

TEST_CASE("bench leaves out what the context lacks", "[cli]") {
    const Outcome outcome = runShoal(
        {"bench", "--quick", "--only", "1,024 quads: fused, in", "--seconds", "0.05"},
        {.environment = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}, {"MESA_GLSL_VERSION_OVERRIDE", "330"}}});
    REQUIRE(outcome.code == 0);
    if (outcome.out.find("left out") == std::string::npos) {
        WARN("skipped: this driver takes no notice of MESA_GL_VERSION_OVERRIDE");
        return;
    }
    CHECK_THAT(outcome.out, Catch::Contains("left out: needs OpenGL 4.3; this context has 3.3"));
    CHECK_THAT(outcome.err, Catch::Contains("warning: the fused path needs OpenGL 4.3"));
}

TEST_CASE("bench refuses what it cannot do", "[cli]") {
    refusal({"bench", "--quick", "--report", ""}, "--report: expected a value, found nothing");
    refusal({"bench", "--seconds", "0"}, "--seconds: expected a time above 0, at most 3600 s, found \"0\"");
    refusal({"bench", "--seconds", "nan"}, "--seconds: expected a time above 0");
    refusal({"bench", "--seconds", "ten"},
            "--seconds: expected a time above 0, at most 3600 s, found \"ten\"");
    refusal({"bench", "--context", "egll"}, "did you mean \"egl\"?");
    refusal({"bench", "--quik"}, "unknown option --quik (did you mean \"--quick\"?)");
    refusal({"bench", "squares.scene.json"}, "squares.scene.json");
    refusal({"bench", "sorr"}, "bench: unknown word \"sorr\" (did you mean \"sort\"?)");
    refusal({"bench", "sort", "--only", "radix"}, "--only is not of bench sort");
    refusal({"bench", "collide", "--only", "squids"}, "there are \"molecules\" and \"searches\"");
    const std::string none = refusal({"bench", "--only", "squids"}, "nothing has \"squids\" in its name");
    CHECK_THAT(none, Catch::Contains("16,384 crosses"));
}

TEST_CASE("bench sort reports every sort beside the published figures", "[cli]") {
    const Outcome outcome = runShoal({"bench", "sort", "--quick", "--seconds", "0.05", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    const std::vector<JsonValue>& cases = member(report, "cases").items;
    REQUIRE(cases.size() == 14);  // seven at two sizes
    for (const JsonValue& one : cases) {
        CAPTURE(member(one, "case").text);
        CHECK(member(one, "pairs").number == member(one, "side").number * member(one, "side").number);
        if (one.find("leftOut")) continue;
        CHECK(member(one, "samples").number >= 3);
        CHECK(member(one, "minSeconds").number > 0);
        CHECK(member(one, "medianSeconds").number >= member(one, "minSeconds").number);
        CHECK(member(one, "millionItemsPerSecond").number ==
              Approx(member(one, "pairs").number * 1e-6 / member(one, "minSeconds").number));
    }
    CHECK(member(report, "published").items.size() >= 3);
    for (const JsonValue& target : member(report, "targets").items)
        member(target, "measured");
}

TEST_CASE("bench sort prints a table, without radix below OpenGL 4.3", "[cli]") {
    const Outcome outcome = runShoal({"bench", "sort", "--quick", "--seconds", "0.05"});
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("million/s") && Catch::Contains("bitonic, rows only") &&
                                Catch::Contains("GP/FP packed") &&
                                Catch::Contains("radix, times as fast as bitonic"));
    const Outcome old = runShoal(
        {"bench", "sort", "--quick", "--seconds", "0.05"},
        {.environment = {{"MESA_GL_VERSION_OVERRIDE", "3.3"}, {"MESA_GLSL_VERSION_OVERRIDE", "330"}}});
    REQUIRE(old.code == 0);
    if (old.out.find("left out") == std::string::npos) {
        WARN("skipped: this driver takes no notice of MESA_GL_VERSION_OVERRIDE");
        return;
    }
    CHECK_THAT(old.out, Catch::Contains("left out: needs OpenGL 4.3; this context has 3.3") &&
                            Catch::Contains("times as fast as bitonic at 256 x 256"));
}

TEST_CASE("bench collide reports contact beside the baseline as JSON", "[cli]") {
    const Outcome outcome =
        runShoal({"bench", "collide", "--quick", "--only", "molecules", "--seconds", "0.05", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    const std::vector<JsonValue>& rows = member(report, "contact").items;
    REQUIRE(rows.size() == 3);
    for (const JsonValue& row : rows) {
        CAPTURE(member(row, "density").text, member(row, "quads").number);
        if (row.find("leftOut")) continue;
        CHECK(member(row, "spheres").number == 4 * member(row, "quads").number);
        CHECK(member(row, "contacts").number > 20);
        CHECK(member(row, "dropped").number == 0);
        double sum = 0;
        for (const char* pass : {"grid", "search", "response"})
            sum += member(member(row, pass), "minSeconds").number;
        CHECK(sum > 0);
        CHECK(member(member(row, "contact"), "minSeconds").number >= sum * 0.999);
        CHECK(member(row, "overBaseline").number ==
              Approx(member(member(row, "contact"), "minSeconds").number /
                     member(member(row, "baseline"), "minSeconds").number));
    }
    CHECK(member(report, "targets").items.size() == 2);
}

TEST_CASE("bench collide tells what each search finds", "[cli]") {
    const Outcome outcome =
        runShoal({"bench", "collide", "--quick", "--only", "searches", "--seconds", "0.05", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json(), &searches = member(report, "searches");
    if (member(searches, "overDensity").items.empty()) {
        WARN("skipped: no compute shaders");
        return;
    }
    CHECK(member(report, "contact").items.empty());
    REQUIRE(member(searches, "overDensity").items.size() == 12);
    for (const JsonValue& one : member(searches, "overDensity").items) {
        const double contacts = member(one, "contacts").number, found = member(one, "found").number;
        CAPTURE(member(one, "search").text, contacts, found);
        CHECK(contacts > 10);
        if (member(one, "search").text == "exact")
            CHECK(found == contacts);
        else
            CHECK((found > 0 && found <= contacts));  // of few contacts the staggered grids may see all
    }
    double before = 0;
    for (const JsonValue& one : member(searches, "overSpeed").items) {
        // the longer the step, the fewer are seen
        const double found = member(one, "found").number;
        if (member(one, "radiiInAStep").number > 0.1) CHECK(found <= before);
        CHECK(found > 0);
        before = found;
    }
}
