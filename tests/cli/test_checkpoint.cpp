// --save, --resume and the watchdog, as a user meets them.
#include <filesystem>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words words(int frames, const Words& more) {
    Words out{"run", squaresScene(), "--headless", "--json", "--frames", std::to_string(frames)};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

JsonValue report(int frames, const Words& more) {
    const Outcome outcome = runShoal(words(frames, more));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.messages().empty());
    return outcome.json();
}

std::string hashOf(const JsonValue& told) {
    return member(told, "hash").text;
}

// Points in a wind that none of them withstands. Weight times speed is beyond what a float can square.
std::string hurricane(const Scratch& scratch, const std::string& drag = "1000",
                      const std::string& weight = "1e15") {
    return scratch.write("storm.scene.json", R"({
  "format": "shoal-scene-1",
  "fields": [{"type": "uniform", "velocity": [1e15, 0, 0], "weight": )" +
                                                 weight +
                                                 R"(}],
  "groups": [{"name": "spray", "molecule": ")" + sourceFile("molecules/point.json") +
                                                 R"(", "count": 70,
    "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "drag": )" +
                                                 drag + "}]\n}\n");
}

}  // namespace

TEST_CASE("a run that is saved goes on in another process, bit for bit", "[cli]") {
    const std::string path = GENERATE("fused", "ping-pong");
    const Scratch scratch;
    const std::string file = scratch.path("deep/half.shoal");
    const JsonValue whole = report(40, {"--path", path});
    const JsonValue half = report(20, {"--path", path, "--save", file});
    REQUIRE(member(half, "written").items.size() == 1);
    CHECK(member(half, "written").items[0].text == file);
    CHECK(hashOf(half) != hashOf(whole));
    const JsonValue rest = report(20, {"--path", path, "--resume", file});
    CHECK(hashOf(rest) == hashOf(whole));
    CHECK(member(rest, "frames").number == 40);
    CHECK(member(rest, "time").number == member(whole, "time").number);
    // and no state crossed the bus in between
    CHECK(member(member(member(member(rest, "busBytes"), "frames"), "state"), "uploaded").number == 0);
}

TEST_CASE("frames count on from where the run was saved", "[cli]") {
    const Scratch scratch;
    report(9, {"--save", scratch.path("s.shoal"), "--save-frames", "0,3,6"});
    CHECK(filesIn(scratch.path("")) ==
          std::vector<std::string>{"s-00000.shoal", "s-00003.shoal", "s-00006.shoal"});
    CHECK(hashOf(report(6, {"--resume", scratch.path("s-00003.shoal")})) == hashOf(report(9, {})));
    CHECK(hashOf(report(9, {"--resume", scratch.path("s-00000.shoal")})) == hashOf(report(9, {})));
    const Words resume{"--resume", scratch.path("s-00006.shoal")};
    const auto with = [&](Words more) {
        more.insert(more.end(), resume.begin(), resume.end());
        return more;
    };
    report(4, with({"--capture", scratch.path("p"), "--size", "16x16"}));
    CHECK(filesIn(scratch.path("p")) == std::vector<std::string>{"frame-00007.png", "frame-00008.png",
                                                                 "frame-00009.png", "frame-00010.png"});
    report(4, with({"--export", scratch.path("e"), "--export-frames", "6,10"}));
    CHECK(filesIn(scratch.path("e")) == std::vector<std::string>{"state-00006.csv", "state-00010.csv"});
    refusal(words(4, with({"--export", scratch.path("e"), "--export-frames", "5"})),
            "--export-frames: frame 5 is before 6, where the run goes on");
    refusal(words(4, with({"--save", scratch.path("x"), "--save-frames", "11"})),
            "--save-frames: frame 11 is beyond the last, 10");
    refusal(words(4, {"--save-frames", "1"}), "--save-frames requires --save");
}

TEST_CASE("what cannot be resumed or saved says why, in one line", "[cli]") {
    const Scratch scratch;
    const std::string file = scratch.path("s.shoal");
    report(2, {"--save", file});
    refusal(words(2, {"--resume", scratch.path("none")}), "none: no such file");
    refusal(words(2, {"--resume", squaresScene()}), "squares.scene.json: is not a checkpoint of Shoal");
    refusal(words(2, {"--resume", file, "--count", "21"}),
            "s.shoal: is of another scene: its group \"quad\" had 20 molecules, here it has 21");
    refusal(words(2, {"--resume", file, "--seed", "3"}), "another --seed");
    const std::string bytes = readFile(file);
    scratch.write("s.shoal", bytes.substr(0, bytes.size() / 2));
    refusal(words(2, {"--resume", file}), "s.shoal: is cut short");
    std::string damaged = bytes;
    damaged[bytes.size() - 40] ^= 1;
    scratch.write("s.shoal", damaged);
    refusal(words(2, {"--resume", file}), "s.shoal: is damaged");
    scratch.write("s.shoal", bytes);
    // known before the first frame, not after the last
    refusal(words(2, {"--save", file + "/below"}), "s.shoal");
    CHECK(readFile(file) == bytes);
    CHECK(hashOf(report(2, {"--resume", file, "--substeps", "16"})) != hashOf(report(2, {"--resume", file})));
}

TEST_CASE("a run that blows up stops, says who it was and leaves a state to look at", "[cli]") {
    const Scratch scratch;
    const std::string scene = hurricane(scratch);
    for (const std::string path : {"fused", "ping-pong"}) {
        INFO(path);
        const Scratch work;
        const std::string message = refusal({"run", scene, "--headless", "--json", "--path", path},
                                            "storm.scene.json:4:", {.folder = work.path("")});
        for (const char* part : {"stopped at frame 1, 0.0166", "group \"spray\", molecule 0, vertex 0",
                                 "is not finite", "--substeps", "--solver"})
            CHECK_THAT(message, Catch::Contains(part));
        if (path == "ping-pong") {
            CHECK_THAT(message, Catch::Contains("The state before is gone"));
            CHECK(filesIn(work.path("")).empty());
            continue;
        }
        CHECK_THAT(message, Catch::Contains("--resume storm.watchdog.shoal, the state at frame 0"));
        CHECK(filesIn(work.path("")) == std::vector<std::string>{"storm.watchdog.shoal"});
        // it happens again, and with another drag it does not
        refusal({"run", scene, "--headless", "--json", "--frames", "1", "--resume", "storm.watchdog.shoal"},
                "stopped at frame 1", {.folder = work.path("")});
        const std::string calm = hurricane(scratch, "0");
        const Outcome goesOn = runShoal(
            {"run", calm, "--headless", "--json", "--frames", "3", "--resume", "storm.watchdog.shoal"},
            {.folder = work.path("")});
        CHECK(goesOn.code == 0);
        hurricane(scratch);
    }
}

TEST_CASE("what is too fast but finite is saved as it is where the state before is gone", "[cli]") {
    const Scratch scratch;
    const std::string scene = hurricane(scratch, "1000", "1");
    const std::string message = refusal({"run", scene, "--headless", "--json", "--path", "ping-pong"},
                                        "molecule", {.folder = scratch.path("")});
    CHECK_THAT(message, Catch::Contains("m/s; the limit is 10000 m/s") &&
                            Catch::Contains("--resume storm.watchdog.shoal, the state at frame 1"));
    refusal({"run", scene, "--headless", "--json", "--resume", scratch.path("storm.watchdog.shoal")},
            "stopped at frame 1");
}

TEST_CASE("the watchdog leaves its state beside the run's output, and can be left out", "[cli]") {
    const Scratch scratch;
    const std::string scene = hurricane(scratch);
    const Words run{"run", scene, "--headless", "--frames", "4", "--size", "16x16"};
    const auto with = [&](const Words& more) {
        Words out = run;
        out.insert(out.end(), more.begin(), more.end());
        return out;
    };
    refusal(with({"--capture", scratch.path("p")}), "p/storm.watchdog.shoal");
    refusal(with({"--save", scratch.path("s/end.shoal")}), "s/storm.watchdog.shoal");
    CHECK(filesIn(scratch.path("s")) == std::vector<std::string>{"storm.watchdog.shoal"});
    const Outcome unwatched = runShoal(with({"--json", "--no-watchdog"}));
    CHECK(unwatched.code == 0);
    CHECK(member(unwatched.json(), "frames").number == 4);
    // what is no state to go on from is not saved over one that is
    refusal(with({"--save", scratch.path("s/end.shoal"), "--save-frames", "1"}), "stopped at frame 1");
    CHECK(filesIn(scratch.path("s")) == std::vector<std::string>{"storm.watchdog.shoal"});
}
