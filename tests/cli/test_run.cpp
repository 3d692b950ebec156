// `shoal run` without a window: pictures, exports, reports, options and repeatability.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "cli/shoal_command.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words runWords(const Words& more, int frames = 5) {
    Words words{"run", squaresScene(), "--headless", "--size", "160x90", "--frames", std::to_string(frames)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

JsonValue report(const Words& more, int frames = 5) {
    Words words = runWords(more, frames);
    words.emplace_back("--json");
    const Outcome outcome = runShoal(words);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.messages().empty());
    return outcome.json();
}

std::string hashOf(const Words& more, int frames = 5) {
    const std::string hash = member(report(more, frames), "hash").text;
    CHECK(hash.size() == 16);
    return hash;
}

// A row of numbers for each line below the header.
std::vector<std::vector<double>> readCsv(const std::string& file) {
    std::istringstream lines(readFile(file));
    std::string line;
    std::getline(lines, line);
    CHECK(line == "frame,time,group,molecule,vertex,x,y,z,vx,vy,vz,nx,ny,nz");
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
        std::vector<double> row;
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            row.push_back(std::stod(cell));
        rows.push_back(row);
    }
    return rows;
}

void checkPicture(const std::string& file) {
    INFO(file);
    const Image picture = readPng(file);
    CHECK(picture.width == 160);
    CHECK(picture.height == 90);
    std::set<std::array<uint8_t, 3>> colors;
    uint64_t sum = 0;
    for (size_t i = 0; i < picture.pixels.size(); i += 4) {
        colors.insert({picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]});
        sum += picture.pixels[i];
    }
    CHECK(colors.size() > 100);  // sky, ground, squares in their shades
    CHECK(sum / (160 * 90) > 30);
}

// The contexts that need no display, as far as this machine has them.
std::vector<std::string> headlessContexts() {
    std::vector<std::string> found;
    for (const char* context : {"egl", "osmesa"}) {
        if (hasContext(context))
            found.emplace_back(context);
        else
            WARN("skipped on " << context << ": `shoal info` says that it is not available");
    }
    REQUIRE(!found.empty());
    return found;
}

}  // namespace

TEST_CASE("frames are captured as pictures", "[cli]") {
    const std::string context = GENERATE(from_range(headlessContexts()));
    INFO(context);
    const Scratch scratch;
    const JsonValue told = report({"--context", context, "--capture", scratch.path("pictures")});
    CHECK(member(member(told, "context"), "kind").text == context);
    const std::vector<std::string> files = filesIn(scratch.path("pictures"));
    CHECK(files == std::vector<std::string>{"frame-00001.png", "frame-00002.png", "frame-00003.png",
                                            "frame-00004.png", "frame-00005.png"});
    for (const std::string& file : files)
        checkPicture(scratch.path("pictures/" + file));
    CHECK(readFile(scratch.path("pictures/frame-00001.png")) !=
          readFile(scratch.path("pictures/frame-00005.png")));
    REQUIRE(member(told, "written").items.size() == 5);
    CHECK(member(told, "written").items[4].text == scratch.path("pictures/frame-00005.png"));
}

TEST_CASE("every shipped scene runs", "[cli]") {
    int scenes = 0;
    for (const std::string& file : filesIn(sourceFile("models"))) {
        if (!file.ends_with(".scene.json")) continue;
        ++scenes;
        INFO(file);
        const Outcome outcome = runShoal(
            {"run", sourceFile("models/" + file), "--headless", "--count", "100", "--frames", "2", "--json"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        CHECK(member(outcome.json(), "frames").number == 2);
    }
    CHECK(scenes >= 11);
}

TEST_CASE("the report counts births and what found no place", "[cli]") {
    const std::string fountain = sourceFile("models/fountain/fountain.scene.json");
    // 15,000 drops a second: 250 in a frame.
    const auto lives = [&](const std::string& count) {
        const Scratch scratch;
        const Outcome outcome = runShoal({"run", fountain, "--headless", "--frames", "2", "--count", count,
                                          "--export", scratch.path("x.csv"), "--json"});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return member(outcome.json(), "lives").items;
    };
    const std::vector<JsonValue> roomy = lives("600"), full = lives("400");
    REQUIRE(roomy.size() == 2);
    CHECK(member(roomy[0], "group").text == "drops");
    CHECK(member(roomy[0], "capacity").number == 600);
    CHECK(member(roomy[0], "living").number == 500);
    CHECK(member(roomy[0], "reach").number == 500);
    CHECK(member(roomy[0], "born").number == 500);
    CHECK(member(roomy[0], "lost").number == 0);
    CHECK(member(roomy[1], "born").number == 0);  // none has fallen yet
    CHECK(member(full[0], "living").number == 400);
    CHECK(member(full[0], "born").number == 400);
    CHECK(member(full[0], "lost").number == 100);

    const Scratch scratch;
    const Outcome told = runShoal({"run", fountain, "--headless", "--frames", "2", "--count", "400",
                                   "--export", scratch.path("x.csv")});
    CHECK_THAT(told.out,
               Catch::Contains("drops: 400 of 400 places taken, 400 born, 100 lost (no place was free"));
    CHECK_THAT(told.out, Catch::Contains("splashes: 0 of 400 places taken, 0 born\n"));
    const Outcome plain = runShoal(runWords({"--export", scratch.path("plain.csv")}));
    CHECK_THAT(plain.out, !Catch::Contains("born"));
}

TEST_CASE("every second frame, and one picture alone", "[cli]") {
    const Scratch scratch;
    CHECK(runShoal(runWords({"--capture", scratch.path("some"), "--capture-every", "2"})).code == 0);
    CHECK(filesIn(scratch.path("some")) == std::vector<std::string>{"frame-00002.png", "frame-00004.png"});
    CHECK(runShoal(runWords({"--capture", scratch.path("one.png")}, 1)).code == 0);
    checkPicture(scratch.path("one.png"));
}

TEST_CASE("a run that asks for nothing leaves pictures and says where", "[cli]") {
    const Scratch scratch;
    Words words = runWords({});
    const Outcome outcome = runShoal(words, {.folder = scratch.path("")});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("pictures: pictures/squares"));
    CHECK_THAT(outcome.err, Catch::Contains("5 of 5"));
    const std::vector<std::string> files = filesIn(scratch.path("pictures/squares"));
    REQUIRE(files.size() == 5);
    checkPicture(scratch.path("pictures/squares/" + files.back()));
}

TEST_CASE("the state is exported as CSV", "[cli]") {
    const std::string context = GENERATE(from_range(headlessContexts()));
    const Scratch scratch;
    report({"--context", context, "--export", scratch.path("x.csv"), "--export-frames", "0,5"});
    REQUIRE(filesIn(scratch.path("")) == std::vector<std::string>{"x-00000.csv", "x-00005.csv"});
    const auto first = readCsv(scratch.path("x-00000.csv")), last = readCsv(scratch.path("x-00005.csv"));
    REQUIRE(first.size() == 80);  // 20 squares of 4 corners
    REQUIRE(last.size() == 80);
    for (size_t i = 0; i < 80; ++i) {
        REQUIRE(first[i].size() == 14);
        CHECK(first[i][0] == 0);
        CHECK(last[i][0] == 5);
        CHECK(last[i][1] == Approx(5.0 / 60));
        CHECK(first[i][3] == double(i / 4));
        CHECK(first[i][4] == double(i % 4));
        for (int axis = 8; axis < 11; ++axis)
            CHECK(first[i][size_t(axis)] == 0);  // starts at rest
        CHECK(std::hypot(first[i][11], first[i][12], first[i][13]) == Approx(1));
        CHECK(last[i][6] < first[i][6]);  // falls
    }
    for (size_t m = 0; m < 20; ++m) {
        // where the scene puts it: centre within the box, sides of 0.2 m
        double center[3] = {0, 0, 0};
        for (size_t v = 0; v < 4; ++v)
            for (size_t axis = 0; axis < 3; ++axis)
                center[axis] += first[4 * m + v][5 + axis] / 4;
        CHECK((center[0] >= -1.5 && center[0] <= 0.8));
        CHECK((center[1] >= 0.6 && center[1] <= 2.2));
        CHECK((center[2] >= -1 && center[2] <= 1));
        const auto &a = first[4 * m], &b = first[4 * m + 1];
        CHECK(std::hypot(a[5] - b[5], a[6] - b[6], a[7] - b[7]) == Approx(0.2).epsilon(1e-5));
    }
}

TEST_CASE("the last frame alone keeps the name that was asked for", "[cli]") {
    const Scratch scratch;
    report({"--export", scratch.path("end.csv")}, 3);
    CHECK(readCsv(scratch.path("end.csv")).front().front() == 3);
    report({"--export", scratch.path("states")}, 3);
    CHECK(filesIn(scratch.path("states")) == std::vector<std::string>{"state-00003.csv"});
}

TEST_CASE("the state is exported as PLY", "[cli]") {
    const Scratch scratch;
    report({"--export", scratch.path("end.ply")}, 2);
    std::istringstream lines(readFile(scratch.path("end.ply")));
    std::string line;
    size_t vertices = 0, faces = 0, properties = 0, body = 0;
    std::getline(lines, line);
    CHECK(line == "ply");
    while (std::getline(lines, line) && line != "end_header") {
        std::sscanf(line.c_str(), "element vertex %zu", &vertices);
        std::sscanf(line.c_str(), "element face %zu", &faces);
        properties += line.rfind("property ", 0) == 0 ? 1 : 0;
    }
    CHECK(vertices == 80);
    CHECK(faces == 40);
    CHECK(properties == 13);
    std::vector<std::string> rows;
    while (std::getline(lines, line))
        rows.push_back(line);
    body = rows.size();
    REQUIRE(body == vertices + faces);
    CHECK(std::count(rows[0].begin(), rows[0].end(), ' ') == 11);
    for (size_t i = vertices; i < body; ++i) {
        int corners = 0, a = -1, b = -1, c = -1;
        CHECK(std::sscanf(rows[i].c_str(), "%d %d %d %d", &corners, &a, &b, &c) == 4);
        CHECK(corners == 3);
        CHECK((std::min({a, b, c}) >= 0 && std::max({a, b, c}) < 80 && a / 4 == b / 4 && b / 4 == c / 4));
    }
}

TEST_CASE("frames move no state over the bus", "[cli]") {
    const std::string context = GENERATE(from_range(headlessContexts()));
    const Scratch scratch;
    const JsonValue told =
        report({"--context", context, "--capture", scratch.path("p"), "--export", scratch.path("x.csv")});
    CHECK(member(told, "frames").number == 5);
    CHECK(member(told, "time").number == Approx(5.0 / 60));
    CHECK(member(told, "stateBytes").number > 0);
    const JsonValue& bytes = member(told, "busBytes");
    const JsonValue& frames = member(bytes, "frames");
    CHECK(member(member(frames, "state"), "uploaded").number == 0);
    CHECK(member(member(frames, "state"), "readBack").number == 0);
    const JsonValue& control = member(frames, "control");
    CHECK(member(control, "uploaded").number + member(control, "readBack").number <= 256 * 5);
    // the meter is not simply off
    CHECK(member(member(member(bytes, "start"), "state"), "uploaded").number > 0);
    CHECK(member(member(member(bytes, "outside"), "state"), "readBack").number > 0);
}

TEST_CASE("the report counts the bytes of births apart", "[cli]") {
    const Scratch scratch;
    writeFile(scratch.path("pool.scene.json"), R"({
        "format": "shoal-scene-1", "name": "pool",
        "groups": [{"particle": {"size": 0.01}, "life": {"span": 1, "allocator": "stack"},
                    "emitters": [{"from": "point", "speed": 1, "rate": 600}]}]})");
    const Outcome outcome =
        runShoal({"run", scratch.path("pool.scene.json"), "--headless", "--frames", "4", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue told = outcome.json();
    const JsonValue& births = member(member(member(told, "busBytes"), "frames"), "births");
    CHECK(member(births, "uploaded").number == 4 * 4 * 10);  // 10 born a frame, a place of 4 bytes each
    CHECK(member(births, "readBack").number == 0);
}

TEST_CASE("the seed decides the run, bit for bit", "[cli]") {
    const std::string context = GENERATE(from_range(headlessContexts()));
    const Words chosen{"--context", context, "--seed", "7"};
    const std::string hash = hashOf(chosen);
    CHECK(hashOf(chosen) == hash);
    CHECK(hashOf({"--context", context, "--seed", "8"}) != hash);
    CHECK(hashOf({"--context", context, "--seed", "18446744073709551615"}) != hash);
}

TEST_CASE("options take the place of what the scene says", "[cli]") {
    const std::string plain = hashOf({});
    CHECK(hashOf({"--substeps", "8"}) != plain);
    CHECK(hashOf({"--solver", "euler"}) != plain);
    CHECK(hashOf({"--solver", "leapfrog"}) == plain);
    const JsonValue slow = report({"--dt", "0.01"});
    CHECK(member(slow, "time").number == Approx(0.05));
    CHECK(member(slow, "hash").text != plain);

    const Scratch scratch;
    report({"--count", "33", "--export", scratch.path("more.csv")}, 1);
    CHECK(readCsv(scratch.path("more.csv")).size() == 33 * 4);
}

TEST_CASE("pictures and timings do not change the result", "[cli]") {
    const Scratch scratch;
    const std::string plain = hashOf({});
    CHECK(hashOf({"--capture", scratch.path("p")}) == plain);
    CHECK(member(report({"--timings"}), "hash").text == plain);
}

TEST_CASE("each pass of a path is timed", "[cli]") {
    const std::map<std::string, std::set<std::string>> expected{
        {"fused", {"fused"}}, {"ping-pong", {"advect", "collide", "normals", "records", "restore", "watch"}}};
    for (const auto& [path, all] : expected) {
        const JsonValue timed = report({"--timings", "--path", path});
        std::set<std::string> passes;
        for (const JsonValue& pass : member(timed, "stages").items) {
            passes.insert(member(pass, "stage").text);
            CHECK(member(pass, "callsPerFrame").number >= 1);
            CHECK(member(pass, "minSeconds").number >= 0);
            CHECK(member(pass, "medianSeconds").number >= member(pass, "minSeconds").number);
        }
        CHECK(passes == all);
    }
}

TEST_CASE("a video, or the program that it needs", "[cli]") {
    const Scratch scratch;
    const std::string video = scratch.path("out.mp4");
    const std::string message =
        refusal(runWords({"--capture", video}, 3), "ffmpeg", {.environment = {{"PATH", scratch.path("")}}});
    CHECK_THAT(message, Catch::Contains("apt install"));
    CHECK(filesIn(scratch.path("")).empty());
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    REQUIRE(runShoal(runWords({"--capture", video}, 3)).code == 0);
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"out.mp4"});
    CHECK(readFile(video).substr(4, 4) == "ftyp");
}

// Mesa alone takes notice of the variable.
TEST_CASE("a picture is the same on drivers that gather no texels and write no stencil values", "[cli]") {
    const Scratch scratch;
    const auto picture = [&](const std::string& folder, const Surroundings& surroundings) {
        const Outcome out = runShoal({"run", "hello", "--headless", "--frames", "1", "--size", "320x180",
                                      "--capture", scratch.path(folder)},
                                     surroundings);
        INFO(out.err);
        REQUIRE(out.code == 0);
        return readPng(scratch.path(folder) + "/frame-00001.png").pixels;
    };
    const Surroundings without{
        .environment = {{"MESA_EXTENSION_OVERRIDE", "-GL_ARB_gpu_shader5 -GL_ARB_shader_stencil_export"}}};
    const std::vector<uint8_t> a = picture("with", {}), b = picture("without", without);
    REQUIRE(a.size() == b.size());
    int most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(int(a[i]) - int(b[i])));
    CHECK(most <= 2);
}
