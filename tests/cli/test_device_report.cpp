// `shoal bench --report`: one file about a device, whatever fails; and `shoal explain --cost`.
#include <csignal>
#include <filesystem>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace fs = std::filesystem;

namespace {

// The fast part of a report; it must hold what the rest holds.
Words reportWords(const std::string& file, const std::string& only) {
    return {"bench", "--report", file, "--quick", "--seconds", "0.05", "--only", only};
}

// The shipped data in a folder of its own, to be damaged.
std::string copiedData(const Scratch& scratch) {
    const fs::path folder = scratch / "data";
    fs::create_directories(folder);
    for (const char* part : {"shaders", "molecules", "models"})
        fs::copy(sourceFile(part), folder / part, fs::copy_options::recursive);
    return folder.string();
}

std::vector<std::string> stagesOf(const JsonValue& report) {
    std::vector<std::string> out;
    for (const JsonValue& stage : member(report, "stages").items)
        out.push_back(member(stage, "stage").text);
    return out;
}

const JsonValue* rowNamed(const JsonValue& rows, const std::string& kind, const std::string& name) {
    for (const JsonValue& row : rows.items)
        if (member(row, "kind").text == kind && member(row, "name").text == name) return &row;
    return nullptr;
}

}  // namespace

TEST_CASE("bench --report writes one file: machine, checks, speeds and drawn scenes", "[cli]") {
    const Scratch scratch;
    const std::string file = scratch.path("new/device.json");
    const Outcome outcome = runShoal(reportWords(file, "hello/hello"));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(filesIn(scratch.folder().string()) == std::vector<std::string>{"new/device.json"});
    CHECK_THAT(outcome.out, Catch::Contains("device.json: ") && Catch::Contains("1 drawn"));
    const JsonValue report = readJson(file);
    CHECK(member(report, "format").text == "shoal-device-1");
    CHECK_FALSE(member(report, "commit").text.empty());
    CHECK(member(report, "date").text.size() == 10);
    for (const char* key : {"processor", "renderer", "vendor", "openGL", "glsl", "kind"})
        CHECK_FALSE(member(member(report, "machine"), key).text.empty());
    const JsonValue& checks = member(report, "checks");
    CHECK(checks.items.size() == 4);  // its state, its picture, and two of its paths against one another
    for (const JsonValue& check : checks.items) {
        INFO(member(check, "kind").text << ": " << member(check, "name").text);
        if (check.find("leftOut")) continue;
        CHECK(member(check, "held").boolean);
        CHECK(member(check, "ofTolerance").number <= 1);
        CHECK_FALSE(member(check, "worst").text.empty());
    }
    CHECK(rowNamed(checks, "state", "hello/hello") != nullptr);
    CHECK(rowNamed(checks, "picture", "hello/hello") != nullptr);
    REQUIRE(member(report, "drawn").items.size() == 1);
    const JsonValue& drawn = member(report, "drawn").items[0];
    CHECK(member(drawn, "width").number == 1280);
    CHECK(member(drawn, "molecules").number == 20);
    for (const char* part : {"simulate", "draw"}) {
        CHECK(member(member(drawn, part), "minSeconds").number > 0);
        member(member(drawn, part), "deviceMinSeconds");
    }
    const Outcome timed = runShoal({"run", "hello/hello", "--headless", "--frames", "2", "--size", "64x36",
                                    "--timings", "--json", "--capture", scratch.path("pictures")});
    INFO(timed.err);
    REQUIRE(timed.code == 0);
    CHECK(stagesOf(drawn).size() > 5);
    CHECK(stagesOf(drawn) == stagesOf(timed.json()));
    CHECK(report.find("speeds") == nullptr);  // none is called so
}

TEST_CASE("bench --report measures the cases that are asked for, with the device's own times", "[cli]") {
    const Scratch scratch;
    const std::string file = scratch.path("device.json");
    const Outcome outcome = runShoal(reportWords(file, "1,024 quads: ping"));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = readJson(file);
    const std::vector<JsonValue>& cases = member(member(report, "speeds"), "cases").items;
    REQUIRE(cases.size() == 2);
    for (const JsonValue& one : cases) {
        CHECK(member(one, "minSeconds").number > 0);
        const bool software = member(member(report, "machine"), "software").boolean;
        CHECK((member(one, "deviceMinSeconds").kind == JsonValue::Kind::null) == software);
    }
    CHECK(member(report, "checks").items.empty());
}

TEST_CASE("a broken shader is one failed row of the report, with the driver's words", "[cli]") {
    const Scratch scratch;
    const std::string data = copiedData(scratch), file = scratch.path("device.json");
    const fs::path shader = fs::path(data) / "shaders" / "solver" / "xpbd.glsl";
    writeFile(shader, readFile(shader) + "\nfloat broken() { return notDeclared; }\n");
    const Outcome outcome =
        runShoal(reportWords(file, "state: solver"), {.environment = {{"SHOAL_DATA", data}}});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = readJson(file), &checks = member(report, "checks");
    const size_t count = checks.items.size();  // one a solver
    CHECK(count > 5);
    for (const JsonValue& check : checks.items) {
        const bool broken = member(check, "name").text == "solver xpbd";
        INFO(member(check, "name").text);
        CHECK(member(check, "held").boolean == !broken);
        CHECK((check.find("failed") != nullptr) == broken);
        if (broken)
            CHECK_THAT(member(check, "failed").text,
                       Catch::Contains("solver/xpbd.glsl") && Catch::Contains("notDeclared"));
    }
    CHECK_THAT(outcome.out,
               Catch::Contains(std::to_string(count - 1) + " of " + std::to_string(count) + " checks held") &&
                   Catch::Contains("solver xpbd: "));
}

TEST_CASE("a broken shader of a case is one failed case of the report, and ends a bench without one",
          "[cli]") {
    const Scratch scratch;
    const std::string data = copiedData(scratch), file = scratch.path("device.json");
    const Surroundings damaged{.environment = {{"SHOAL_DATA", data}}};
    const fs::path shader = fs::path(data) / "shaders" / "bench" / "copy.comp";
    writeFile(shader, readFile(shader) + "\nfloat broken() { return notDeclared; }\n");
    const Outcome outcome = runShoal(reportWords(file, "1,024 quads: copy"), damaged);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = readJson(file);
    int failed = 0;
    for (const JsonValue& one : member(member(report, "speeds"), "cases").items) {
        if (one.find("leftOut")) continue;
        const JsonValue* words = one.find("failed");
        CHECK((words != nullptr) == (member(one, "case").text == "copy, kernel"));
        if (words) CHECK_THAT(words->text, Catch::Contains("notDeclared"));
        failed += words != nullptr;
    }
    if (failed == 0) WARN("skipped: no compute shaders");
    if (failed > 0)
        refusal({"bench", "--quick", "--only", "1,024 quads: copy", "--seconds", "0.05"}, "copy.comp",
                damaged);
}

TEST_CASE("bench --report refuses what it cannot do, and leaves nothing behind", "[cli]") {
    const Scratch scratch;
    refusal({"bench", "--report", "/proc/none/device.json"}, "/proc/none");
    refusal({"bench", "sort", "--report", scratch.path("a.json")}, "--report is of bench without a word");
    refusal({"bench", "--json", "--report", scratch.path("a.json")}, "--report");
    refusal(reportWords(scratch.path("a.json"), "squids"), "nothing has \"squids\" in its name");
    CHECK(filesIn(scratch.folder().string()).empty());

    // what was there stays when it ends early
    scratch.write("b.json", "before");
    StartedShoal started(reportWords(scratch.path("b.json"), "state: solver"));
    started.waitForError("checks: ");
    started.send(SIGTERM);
    CHECK(started.finish().signal == SIGTERM);
    CHECK(readFile(scratch / "b.json") == "before");
    CHECK(filesIn(scratch.folder().string()) == std::vector<std::string>{"b.json"});
}

TEST_CASE("explain --cost tells what bounds each kernel, and keeps the rates of the device", "[cli]") {
    const Scratch scratch;
    const Surroundings kept{.environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
    const Words words = {"explain", squaresScene(), "--cost", "--json"};
    const Outcome outcome = runShoal(words, kept);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json(), &cost = member(report, "cost");
    REQUIRE(member(cost, "kernels").items.size() == 1);
    const JsonValue& kernel = member(cost, "kernels").items[0];
    CHECK(member(kernel, "bytesPerMolecule").number == 208);  // two times six 4-vectors, and a record
    CHECK(member(kernel, "stateFetchesPerMolecule").number == 7);
    CHECK(member(kernel, "operationsPerMolecule").number > 1000);
    for (const char* key :
         {"tableFetchesPerMolecule", "sharedBytes", "estimatedRegisters", "estimatedOccupancy"})
        member(kernel, key);
    const JsonValue& rates = member(cost, "rates");
    if (rates.kind == JsonValue::Kind::null) {
        WARN("skipped: no compute shaders");
        return;
    }
    CHECK(member(rates, "bytesPerSecond").number > 1e8);
    CHECK(member(rates, "operationsPerSecond").number > 1e8);
    CHECK_FALSE(member(rates, "kept").boolean);
    const std::string bound = member(kernel, "bound").text;
    CHECK((bound == "memory" || bound == "arithmetic"));
    CHECK((bound == "memory") ==
          (member(kernel, "memorySeconds").number > member(kernel, "arithmeticSeconds").number));

    const JsonValue again = runShoal(words, kept).json();
    CHECK(member(member(member(again, "cost"), "rates"), "kept").boolean);
    CHECK(member(member(member(again, "cost"), "rates"), "bytesPerSecond").number ==
          member(rates, "bytesPerSecond").number);

    const Outcome text = runShoal({"explain", squaresScene(), "--cost"}, kept);
    CHECK(text.code == 0);
    CHECK_THAT(text.out, Catch::Contains("kept from before") && Catch::Contains(bound) &&
                             Catch::Contains("within a factor of two"));
    refusal({"explain", squaresScene(), "--cost", "--path", "ping-pong"},
            "--cost is of the fused path's kernels");
    refusal({"explain", squaresScene(), "--cost", "--shader"}, "--shader");
}
