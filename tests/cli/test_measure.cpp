// `shoal measure` and --error: what they report, keep and refuse.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Quads that turn in a shear flow: springs, drag and a field that varies, nothing that is chaotic.
std::string shearScene(const Scratch& scratch, const std::string& more = "") {
    const std::string text = R"({
  "format": "shoal-scene-1", "name": "shear", "gravity": [0, -9.81, 0],
  "fields": [{"type": "shear", "velocity": [2, 0, 0], "gradient": [[0, 0.8, 0], [0, 0, 0.3], [-0.5, 0, 0]]}],
  "groups": [{"molecule": ")" +
                             sourceFile("molecules/quad.json") +
                             R"(", "count": 40, "drag": 1, "spin": [3, -4, 2],
    "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}, "turn": "any"})" +
                             more + R"(}]
})";
    return scratch.write("shear.scene.json", text);
}

Words quick(const std::string& scene, const Words& more = {}) {
    Words out = {"measure", scene, "--solvers", "leapfrog,euler", "--duration", "0.2", "--molecules", "2"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

// Where what is found is kept.
Surroundings cacheIn(const Scratch& scratch) {
    return {.environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
}

}  // namespace

TEST_CASE("measure reports every point as JSON and CSV", "[cli]") {
    const Scratch scratch;
    const Outcome outcome = runShoal(
        quick(shearScene(scratch), {"--json", "--csv", scratch.path("points.csv")}), cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.err,
               Catch::Contains("This takes about ") && Catch::Contains("Errors and times take about "));
    const JsonValue report = outcome.json();
    CHECK_FALSE(member(member(report, "machine"), "processor").text.empty());
    CHECK_FALSE(member(member(report, "context"), "renderer").text.empty());
    CHECK_FALSE(member(report, "commit").text.empty());
    CHECK(member(report, "date").text.size() == 10);
    CHECK(member(report, "duration").number == Approx(0.2));
    CHECK(member(report, "target").number == 1e-3);
    CHECK(member(report, "chaotic").kind == JsonValue::Kind::null);
    CHECK(member(report, "referenceError").number < 1e-5);
    const JsonValue& group = member(report, "groups").items.at(0);
    CHECK(member(group, "measuredMolecules").number == 2);
    CHECK(member(group, "timedMolecules").number == 40);

    const std::vector<JsonValue>& points = member(report, "points").items;
    int measured = 0, front = 0;
    double before = 1;  // leapfrog's error must fall
    for (const JsonValue& point : points) {
        const std::string solver = member(point, "solver").text;
        CHECK((solver == "leapfrog" || solver == "euler"));
        if (member(point, "outcome").text != "measured") {
            CHECK_FALSE(member(point, "why").text.empty());
            continue;
        }
        ++measured;
        const JsonValue& error = member(point, "error");
        const double total = member(error, "total").number;
        CHECK(total == Approx(std::hypot(member(error, "centroid").number, member(error, "shape").number)));
        CHECK(member(error, "worst").number >= total);
        CHECK(member(member(point, "drift"), "energy").number >= 0);
        front += member(point, "front").boolean;
        if (member(point, "samples").number > 0)
            CHECK(member(point, "medianSecondsPerVertexAndSecond").number >=
                  member(point, "minSecondsPerVertexAndSecond").number);
        if (solver != "leapfrog" || member(point, "substeps").number > 8 ||
            member(point, "fieldSampling").text != "vertexSubstep")
            continue;
        CHECK(total < before);
        before = total;
    }
    CHECK(measured > 6);
    CHECK(front > 1);
    CHECK(before < 1e-3);
    CHECK(member(member(report, "chosen"), "error").number < 1e-3);

    const std::string csv = readFile(scratch.path("points.csv"));
    CHECK(size_t(std::count(csv.begin(), csv.end(), '\n')) == points.size() + 1);
    CHECK(csv.rfind("solver,fieldSampling,substeps,", 0) == 0);
    CHECK(std::count(csv.begin(), csv.begin() + ptrdiff_t(csv.find('\n')), ',') == 19);
}

TEST_CASE("measure takes the longest step at which a method is stable, between the halvings", "[cli]") {
    const Scratch scratch;
    const Outcome outcome = runShoal(
        quick(shearScene(scratch, R"(, "stiffness": 2000)"), {"--json", "--samplings", "vertexSubstep"}),
        cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    std::string why;  // "... use at least N substeps ..."
    std::vector<double> taken;
    for (const JsonValue& point : member(report, "points").items) {
        if (member(point, "solver").text != "leapfrog") continue;
        if (member(point, "outcome").text == "refused")
            why = member(point, "why").text;
        else
            taken.push_back(member(point, "substeps").number);
    }
    INFO(why);
    REQUIRE_FALSE(taken.empty());
    CHECK_THAT(why, Catch::Contains(concat("use at least ", taken.front(), " substeps")));
    CHECK(std::log2(taken.front()) != std::floor(std::log2(taken.front())));
}

TEST_CASE("measure prints a table, and says what it did otherwise", "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch, R"(, "release": {"force": 1})");
    const Words words = quick(scene, {"--samplings", "vertexSubstep", "--all"});
    const Outcome outcome = runShoal(words, cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("leapfrog, vertexSubstep") && Catch::Contains("median ns") &&
                                Catch::Contains("pins are held throughout") && Catch::Contains("chosen"));
    CHECK_THAT(outcome.out, !Catch::Contains("vertexFrame"));
}

TEST_CASE("measure ends with the fastest, a balanced and the most exact method, as lines for the scene",
          "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    const Outcome outcome = runShoal(quick(scene, {"--samplings", "vertexSubstep"}), cacheIn(scratch));
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, !Catch::Contains("median ns"));
    std::istringstream in(outcome.out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    REQUIRE(lines.size() > 3);
    double time = 0, error = 1e30;
    for (const char* what : {"fastest", "balanced", "exact"}) {
        const std::string& line = lines[lines.size() - (what[0] == 'f' ? 3 : what[0] == 'b' ? 2 : 1)];
        CAPTURE(line);
        REQUIRE(line.starts_with(what));
        double ms = 0, found = 0;
        REQUIRE(std::sscanf(line.c_str() + 10, "%lf ms a frame, error %lf", &ms, &found) == 2);
        CHECK(ms >= time);
        CHECK(found <= error);
        time = ms;
        error = found;
        std::string text = readFile(scene);
        text.insert(text.find('{') + 1, line.substr(line.find("\"solver\"")) + ",");
        CHECK(runShoal({"check", scratch.write("with.scene.json", text)}).code == 0);
    }
}

TEST_CASE("a reference that ran out of time is no chaos", "[cli]") {
    const Outcome outcome =
        runShoal({"measure", squaresScene(), "--seconds", "2", "--count", "20", "--solvers", "leapfrog",
                  "--samplings", "vertexSubstep", "--molecules", "2", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    CHECK(member(report, "chaotic").kind == JsonValue::Kind::null);
    // on a slow machine there may be none, and a word of why
    if (member(report, "tooStiff").kind == JsonValue::Kind::null)
        CHECK(member(report, "referenceError").number < 0.03);
    else
        CHECK(member(report, "referenceError").kind == JsonValue::Kind::null);
}

TEST_CASE("what is too stiff for a reference has times, and no errors", "[cli]") {
    const Scratch scratch;
    std::string quad = readFile(sourceFile("molecules/quad.json"));
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"\"mass\": 0.005", "\"mass\": 0.01"},
                                   {"\"stiffness\": 20", "\"stiffness\": 1e12"}}) {
        REQUIRE(quad.find(from) != std::string::npos);
        quad.replace(quad.find(from), from.size(), to);
    }
    scratch.write("quad.json", quad);
    const std::string scene = scratch.write("stiff.scene.json", R"({
  "format": "shoal-scene-1", "name": "stiff",
  "groups": [{"molecule": "quad.json", "count": 4, "spin": [3, -4, 2],
    "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}}}]
})");
    const Outcome outcome = runShoal(
        {"measure", scene, "--solvers", "bdf2-xpbd", "--molecules", "1", "--json"}, cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    CHECK_THAT(member(report, "tooStiff").text, Catch::Contains("too stiff for a reference in 10 s"));
    CHECK(member(report, "chaotic").kind == JsonValue::Kind::null);
    CHECK_THAT(member(report, "notChosen").text, Catch::Contains("too stiff for a reference in 3 s"));
    const JsonValue& first = member(report, "points").items.at(0);
    CHECK(member(first, "error").kind == JsonValue::Kind::null);
    CHECK(member(first, "samples").number > 0);
    refusal({"explain", scene, "--error", "1e-3", "--solver", "bdf2-xpbd"},
            "too stiff for a reference in 3 s", cacheIn(scratch));
}

TEST_CASE("measure with next to no time measures one method, and says in one sentence what it left out",
          "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    const Outcome outcome =
        runShoal(quick(scene, {"--seconds", "0.001", "--error", "1e-3", "--json"}), cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    CHECK_THAT(member(report, "notChosen").text, Catch::Contains("no time is left to look for a method"));
    const std::vector<JsonValue>& notes = member(report, "notes").items;
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes.front().text,
               Catch::Contains("--seconds 0.001 is too short for all of it: 5 of 6 methods were not tried, "
                               "the choice of a method ended early, "));
    int timed = 0;
    for (const JsonValue& point : member(report, "points").items) {
        if (member(point, "outcome").text == "measured")
            timed += member(point, "samples").number > 0;
        else
            CHECK_FALSE(member(point, "why").text.empty());
    }
    CHECK(timed == 1);
}

TEST_CASE("--error finds a method, once", "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    const Words words = {"run",    scene,     "--headless", "--frames",        "2",
                         "--json", "--error", "1e-3",       "--error-seconds", "1000"};
    const Outcome first = runShoal(words, cacheIn(scratch));
    INFO(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.err, Catch::Contains("error 0.001: ") && Catch::Contains("found in "));
    const Outcome second = runShoal(words, cacheIn(scratch));
    CHECK_THAT(second.err, Catch::Contains("as found before"));
    CHECK(member(second.json(), "hash").text == member(first.json(), "hash").text);

    const Outcome explained = runShoal({"explain", scene, "--error", "1e-3", "--json"}, cacheIn(scratch));
    REQUIRE(explained.code == 0);
    const JsonValue calibration = member(explained.json(), "calibration");
    CHECK(member(calibration, "error").number < 1e-3);
    // of all molecules
    CHECK(member(calibration, "molecules").number == 40);
    CHECK(member(calibration, "unknown").number == 0);
    CHECK(member(calibration, "above").number == 0);
    CHECK(member(calibration, "worst").number >= member(calibration, "error").number);
    CHECK_THAT(member(calibration, "how").text, Catch::Contains("40 by the reference"));
    CHECK_THAT(first.err, Catch::Contains(" at worst of 40 molecules"));
    CHECK(member(calibration, "candidates").items.size() >= 7);
    CHECK_THAT(runShoal({"explain", scene, "--error", "1e-3"}, cacheIn(scratch)).out,
               Catch::Contains("as found before") && Catch::Contains("gets there"));

    // narrowed; a kept file that is damaged is measured anew
    for (const std::string& file : filesIn(scratch.path("cache")))
        if (file.find("calibrations") != std::string::npos) scratch.write("cache/" + file, "{");
    const Outcome narrowed = runShoal({"explain", scene, "--error", "1e-2", "--solver", "euler",
                                       "--field-sampling", "vertexSubstep", "--json"},
                                      cacheIn(scratch));
    REQUIRE(narrowed.code == 0);
    CHECK(member(member(narrowed.json(), "calibration"), "solver").text == "euler");
    CHECK_THAT(runShoal(words, cacheIn(scratch)).err, Catch::Contains("found in "));
}

TEST_CASE("--error takes as many substeps as a frame may have", "[cli]") {
    const Scratch scratch;
    // stable with 668 and more
    const Outcome outcome = runShoal(
        {"explain", shearScene(scratch, R"(, "stiffness": 4e5)"), "--error", "0.5", "--error-seconds", "1000",
         "--solver", "leapfrog", "--field-sampling", "vertexSubstep", "--json"},
        cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(member(member(outcome.json(), "calibration"), "substeps").number > 667);
}

TEST_CASE("--error refuses what cannot be had", "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    for (const char* bad : {"0", "-1e-3", "nan", "2"})
        refusal({"run", scene, "--headless", "--error", bad}, "--error: expected a relative error above 0");
    refusal({"explain", scene, "--error", "small"},
            "--error: expected a relative error above 0, at most 1, found \"small\"");
    refusal({"run", scene, "--headless", "--error", "1e-30"}, "--error 1e-30 is out of reach: single floats");
    refusal({"run", scene, "--headless", "--error-seconds", "2"}, "--error-seconds requires --error");
    const std::string message = refusal(
        {"explain", scene, "--error", "1e-4", "--solver", "euler", "--substeps", "8"},
        "--error 0.0001 is out of reach for a sample of its molecules: the nearest is euler with 8 substeps",
        cacheIn(scratch));
    CHECK_THAT(message, Catch::Contains("which has an error of") && Catch::Contains("shear.scene.json"));
}

TEST_CASE("measure refuses what it cannot do", "[cli]") {
    refusal({"measure"}, "measure: expected a scene file");
    refusal({"measure", squaresScene(), "--solvers", "eulr"},
            "--solvers: unknown solver \"eulr\" (did you mean");
    refusal({"measure", squaresScene(), "--solvers", "auto"}, "--solvers: expected the names of solvers");
    refusal({"measure", squaresScene(), "--samplings", "vertex"}, "--samplings: unknown sampling \"vertex\"");
    refusal({"measure", squaresScene(), "--duration", "0"}, "--duration: expected a time above 0");
    refusal({"measure", squaresScene(), "--molecules", "0"},
            "--molecules: expected a whole number from 1 to 1024, found \"0\"");
    refusal({"measure", squaresScene(), "--seconds", "nan"}, "--seconds: expected a time above 0");
    refusal({"measure", squaresScene(), "--error", "0"}, "--error: expected a relative error above 0");
    refusal({"measure", "missing.scene.json"}, "missing.scene.json");
}

TEST_CASE("measure --contact reports as text, JSON and CSV", "[cli]") {
    const Scratch scratch;
    scratch.write("pair.scene.json", R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0],
        "colliders": [{"type": "plane"}], "groups": [{"molecule": "point", "drag": 0, "contact": {"radius": 0.1}, "count": 2,
        "place": {"on": "list", "items": [{"position": [0, 0.1, 0]}, {"position": [0, 0.3, 0]}]}}]})");
    const std::string scene = scratch.path("pair.scene.json"), csv = scratch.path("contact.csv");
    const Words words = {"measure",    scene, "--contact",    "--duration", "0.2",
                         "--substeps", "2,4", "--iterations", "1,4"};
    Words asJson = words;
    asJson.insert(asJson.end(), {"--json", "--csv", csv});
    const Outcome outcome = runShoal(asJson, cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    const std::vector<JsonValue>& points = member(report, "points").items;
    REQUIRE(points.size() == 4);
    for (const char* key :
         {"overlap", "largestOverlap", "energyGiven", "momentum", "minSeconds", "secondsPerContact"})
        CHECK(member(points[3], key).number >= 0);
    CHECK((member(points[3], "substeps").number == 4 && member(points[3], "iterations").number == 4));
    CHECK_THAT(readFile(csv), Catch::StartsWith("substeps,iterations,outcome,overlap,largestOverlap,"));
    const Outcome told = runShoal(words, cacheIn(scratch));
    CHECK_THAT(told.out, Catch::Contains("2 molecules, 2 spheres") && Catch::Contains("4 substeps\n"));
    const Words asked = {"explain", scene, "--error", "0.05", "--substeps", "4"};
    CHECK_THAT(runShoal(asked, cacheIn(scratch)).out,
               Catch::Contains("iterations of contact; over 1 s spheres"));
    CHECK_THAT(runShoal(asked, cacheIn(scratch)).out, Catch::Contains("as found before"));
    refusal({"measure", squaresScene(), "--contact"}, "there is no contact to measure");
    refusal({"measure", scene, "--contact", "--iterations", "300"},
            "--iterations: expected a whole number from 1 to 256");
}

TEST_CASE("measure --statistics reports as text, JSON and CSV", "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    const Words words = {"measure",        scene,        "--statistics", "--seeds", "4",
                         "--duration",     "0.2",        "--molecules",  "3",       "--solvers",
                         "leapfrog,euler", "--substeps", "8,2"};
    Words asJson = words;
    asJson.insert(asJson.end(), {"--json", "--csv", scratch.path("statistics.csv")});
    const Outcome outcome = runShoal(asJson, cacheIn(scratch));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    CHECK_FALSE(member(member(report, "machine"), "processor").text.empty());
    CHECK_FALSE(member(member(report, "context"), "renderer").text.empty());
    CHECK(member(report, "seeds").number == 4);
    CHECK(member(report, "displaced").number == 0);
    CHECK(member(member(report, "reference"), "precision").text == "double");
    CHECK(member(member(report, "reference"), "converged").boolean);
    CHECK(member(member(report, "groups").items.at(0), "molecules").number == 3);
    const std::vector<JsonValue>& methods = member(report, "methods").items;
    REQUIRE(methods.size() == 4);
    size_t rows = 0;
    for (const JsonValue& method : methods) {
        CHECK(member(method, "outcome").text == "measured");
        const std::vector<JsonValue>& statistics = member(method, "statistics").items;
        rows += statistics.size();
        double worst = 0;
        for (const JsonValue& statistic : statistics) {
            worst = std::max(worst, member(member(statistic, "relative"), "mean").number);
            CHECK(member(member(statistic, "difference"), "mean").number ==
                  Approx(member(member(statistic, "value"), "mean").number -
                         member(member(statistic, "reference"), "mean").number)
                      .margin(1e-6));
        }
        CHECK(member(member(member(method, "worst"), "relative"), "mean").number == worst);
        CHECK(member(method, "within").number >= worst);
    }
    CHECK(member(methods[0], "solver").text == "leapfrog");
    CHECK(member(methods[1], "substeps").number == 2);
    // of order 1, with a quarter of the substeps
    CHECK(member(methods[3], "within").number > 2 * member(methods[0], "within").number);
    const std::string csv = readFile(scratch.path("statistics.csv"));
    CHECK(size_t(std::count(csv.begin(), csv.end(), '\n')) == rows + 1);
    CHECK(csv.rfind("solver,substeps,group,quantity,unit,statistic,reference,", 0) == 0);

    const Outcome told = runShoal(words, cacheIn(scratch));
    REQUIRE(told.code == 0);
    CHECK_THAT(told.out, Catch::Contains("seeds 1 to 4") &&
                             Catch::Contains("in double precision on the CPU") &&
                             Catch::Contains("height, m, 95 %") && Catch::Contains("polarisation, mean") &&
                             Catch::Contains("euler with 2 substeps: statistics off by up to ") &&
                             Catch::Contains("a claim takes 30 and more"));
    const Outcome hurried =
        runShoal({"measure", scene, "--statistics", "--seconds", "0.001", "--json"}, cacheIn(scratch));
    REQUIRE(hurried.code == 0);
    CHECK(member(hurried.json(), "seeds").number == 2);
    CHECK_THAT(member(hurried.json(), "notes").items.at(0).text,
               Catch::Contains("--seconds 0.001 is too short for all of it: 2 of 32 seeds"));
}

TEST_CASE("measure --statistics refuses what it cannot do", "[cli]") {
    const Scratch scratch;
    const std::string scene = shearScene(scratch);
    refusal({"measure", scene, "--statistics", "--seeds", "1"},
            "--seeds: expected a whole number from 2 to 10000, found \"1\"");
    refusal({"measure", scene, "--seeds", "4"}, "--seeds requires --statistics");
    refusal({"measure", scene, "--substeps", "4"}, "--substeps needs --statistics or --contact");
    refusal({"measure", scene, "--statistics", "--substeps", "0"},
            "--substeps: expected a whole number from 1 to 1000, found \"0\"");
    refusal({"measure", scene, "--statistics", "--error", "1e-3"}, "--error");
    refusal({"measure", scene, "--statistics", "--all"}, "--all");
    refusal({"measure", scene, "--statistic"}, "--statistic");
    std::string quad = readFile(sourceFile("molecules/quad.json"));
    for (size_t i = quad.find("\"position\""); i != std::string::npos; i = quad.find("\"position\"", i + 30))
        quad.insert(i, "\"pinned\": true, ");
    scratch.write("still.json", quad);
    const std::string still = scratch.write("still.scene.json", R"({
  "format": "shoal-scene-1", "gravity": [0, -9.81, 0],
  "groups": [{"molecule": "still.json", "count": 4,
    "place": {"on": "volume", "box": {"low": [-1, 0, -1], "high": [1, 1, 1]}}}]
})");
    CHECK_THAT(
        refusal({"measure", still, "--statistics"}, "nothing in the scene moves: it has no statistics"),
        Catch::Contains("still.scene.json"));
}
