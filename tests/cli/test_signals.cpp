// Ctrl-C, SIGTERM and SIGKILL, two runs in one place: what is on the disk afterwards, and how the program
// ended.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "cli/shoal_command.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Runs until it is ended.
Words endless(const Words& more) {
    Words out{"run", squaresScene(), "--headless", "--size", "32x18", "--frames", "99999"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

bool hasFfmpeg() {
    const bool there = std::system("command -v ffmpeg >/dev/null 2>&1") == 0;
    if (!there) WARN("skipped: ffmpeg is not installed");
    return there;
}

bool isPlayable(const std::string& video) {
    return std::system(concat("ffmpeg -v error -xerror -i '", video, "' -f null - </dev/null").c_str()) == 0;
}

// That it says it stopped after.
int stoppedAfter(const Outcome& outcome) {
    const std::string words = ") after frame ";
    const size_t at = outcome.err.find(words);
    INFO(outcome.err);
    REQUIRE(at != std::string::npos);
    return std::atoi(outcome.err.c_str() + at + words.size());
}

size_t hidden(const std::string& folder) {
    const std::vector<std::string> files = filesIn(folder);
    return size_t(std::count_if(files.begin(), files.end(), [](const std::string& file) {
        return file.front() == '.' || file.find("/.") != std::string::npos;
    }));
}

}  // namespace

TEST_CASE("Ctrl-C finishes the video, the export and the saved state of the last whole frame",
          "[cli][signals]") {
    if (!hasFfmpeg()) return;
    const Scratch scratch;
    const std::string video = scratch.path("out.mp4"), saved = scratch.path("end.shoal");
    StartedShoal run(
        endless({"--capture", video, "--export", scratch.path("e.pvd"), "--save", saved, "--json"}));
    run.waitForFile(scratch.path("e-00003.vtp"));
    run.send(SIGINT, true);  // as a terminal does: to ffmpeg as well
    const Outcome outcome = run.finish();
    INFO(outcome.err);
    CHECK(outcome.signal == SIGINT);
    const int last = stoppedAfter(outcome);
    CHECK(last >= 3);
    CHECK(member(outcome.json(), "frames").number == last);
    CHECK_THAT(outcome.err, Catch::Contains("stopped by signal 2") && Catch::Contains(video));
    CHECK(isPlayable(video));
    const std::string index = readFile(scratch.path("e.pvd"));
    const std::string number = std::to_string(100000 + last).substr(1);
    CHECK_THAT(index, Catch::Contains("e-" + number + ".vtp") && Catch::Contains("</VTKFile>"));
    CHECK(filesIn(scratch.path("")).size() == size_t(last) + 1 + 3);  // .vtp from frame 0 on; the others
    CHECK(hidden(scratch.path("")) == 0);
    const Outcome on =
        runShoal({"run", squaresScene(), "--headless", "--json", "--frames", "1", "--resume", saved});
    REQUIRE(on.code == 0);
    CHECK(member(on.json(), "frames").number == last + 1);
}

TEST_CASE("a run that is told to end leaves whole files, and the signal to whoever waits", "[cli][signals]") {
    const int signal = GENERATE(SIGTERM, SIGHUP);
    const Scratch scratch;
    StartedShoal run(endless({"--capture", scratch.path("p"), "--export", scratch.path("end.csv")}));
    run.waitForFile(scratch.path("p/frame-00002.png"));
    run.send(signal);
    const Outcome outcome = run.finish();
    INFO(outcome.err);
    CHECK(outcome.signal == signal);
    const int last = stoppedAfter(outcome);
    const std::vector<std::string> pictures = filesIn(scratch.path("p"));
    CHECK(pictures.size() == size_t(last));
    for (const std::string& picture : pictures)
        CHECK(readPng(scratch.path("p/" + picture)).width == 32);
    const std::string table = readFile(scratch.path("end.csv"));
    CHECK_THAT(table, Catch::Contains(concat("\n", last, ",")));  // that frame's state
    CHECK(table.back() == '\n');
    CHECK(hidden(scratch.path("")) == 0);
}

TEST_CASE("a second signal ends a run at once", "[cli][signals]") {
    const Scratch scratch;
    const Scratch bin;  // in place of ffmpeg, what never comes to an end
    const std::string neverDone = bin.write("ffmpeg", "#!/bin/sh\ncat >/dev/null\nexec sleep 600\n");
    std::filesystem::permissions(neverDone, std::filesystem::perms::owner_all);
    const std::string path = bin.path("") + ":" + std::getenv("PATH");
    StartedShoal run(endless({"--capture", scratch.path("out.mp4"), "--export", scratch.path("e.csv"),
                              "--export-frames", "2"}),
                     {.environment = {{"PATH", path}}});
    run.waitForFile(scratch.path("e.csv"));
    CHECK(hidden(scratch.path("")) == 3);  // the video, and that this run writes both
    run.send(SIGINT);
    run.waitForError("a second signal ends it at once");
    run.send(SIGTERM);
    const Outcome outcome = run.finish();
    CHECK(outcome.signal == SIGTERM);
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"e.csv"});
}

TEST_CASE("what a killed run left is swept by the next one that writes there", "[cli][signals]") {
    if (!hasFfmpeg()) return;
    const Scratch scratch;
    StartedShoal run(endless(
        {"--capture", scratch.path("out.mp4"), "--export", scratch.path("e.csv"), "--export-frames", "2"}));
    run.waitForFile(scratch.path("e.csv"));
    const std::string mine = concat(".shoal-", run.process(), "-");
    run.send(SIGKILL);
    CHECK(run.finish().signal == SIGKILL);
    const std::vector<std::string> left = filesIn(scratch.path(""));
    CHECK(std::count(left.begin(), left.end(), mine + "out.mp4") == 1);
    CHECK(std::count(left.begin(), left.end(), mine + "out.mp4.run") == 1);
    std::ofstream(scratch / ".shoal-notes") << "mine";  // Scratch::write would sweep
    // The killed run's ffmpeg may live on for a moment, and holds the video until then.
    const std::vector<std::string> swept = {".shoal-notes", "e.csv", "x.csv"};
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    do {
        CHECK(runShoal(
                  {"run", squaresScene(), "--headless", "--frames", "1", "--export", scratch.path("x.csv")})
                  .code == 0);
    } while (filesIn(scratch.path("")) != swept && std::chrono::steady_clock::now() < end);
    CHECK(filesIn(scratch.path("")) == swept);
}

TEST_CASE("two runs do not write into one folder", "[cli][signals]") {
    const Scratch scratch;
    StartedShoal first(
        endless({"--capture", scratch.path("p"), "--export", scratch.path("e"), "--export-every", "1"}));
    first.waitForFile(scratch.path("e/state-00001.csv"));
    const auto second = [&](const std::string& option, const std::string& target) {
        return Words{"run", squaresScene(), "--headless", "--frames", "2", "--size", "32x18", option, target};
    };
    const std::string busy = concat("is being written by another run, process ", first.process());
    refusal(second("--capture", scratch.path("p")), busy);
    refusal(second("--export", scratch.path("e")), busy);
    CHECK(runShoal(second("--capture", scratch.path("p/other-%03d.png"))).code == 0);
    CHECK(runShoal(second("--export", scratch.path("e/other.csv"))).code == 0);
    first.send(SIGTERM);
    CHECK(first.finish().signal == SIGTERM);
    CHECK(runShoal(second("--capture", scratch.path("p"))).code == 0);
    CHECK(hidden(scratch.path("")) == 0);
}

TEST_CASE("numbers of frames are as long as the last one's, so that names sort", "[cli][signals]") {
    const Scratch scratch;
    Words words = endless({"--capture", scratch.path("p"), "--export", scratch.path("e"), "--export-every",
                           "1", "--save", scratch.path("s.shoal"), "--save-frames", "0,1"});
    *std::find(words.begin(), words.end(), "99999") = "100000";
    StartedShoal run(words);
    run.waitForFile(scratch.path("e/state-000002.csv"));
    run.send(SIGTERM);
    run.finish();
    CHECK(filesIn(scratch.path("p")).front() == "frame-000001.png");
    CHECK(filesIn(scratch.path("e")).front() == "state-000000.csv");
    CHECK(std::filesystem::exists(scratch.path("s-000000.shoal")));
    CHECK(std::filesystem::exists(scratch.path("s-000001.shoal")));
    refusal(
        {"run", squaresScene(), "--headless", "--frames", "100000", "--capture", scratch.path("a-%05d.png")},
        "say %06d");
}

TEST_CASE("what cannot be written is told before the first frame", "[cli][signals]") {
    const Scratch scratch;
    const std::string file = scratch.write("taken", "old");
    for (const char* option : {"--export", "--save"})
        for (const char* name : {"/x.csv", "/deep/x.pvd"})
            refusal(endless({"--capture", scratch.path("p"), option, file + name}),
                    "cannot make this folder");
    refusal(endless({"--export", scratch.path("x.csv"), "--capture", file + "/v.mp4"}),
            "cannot make this folder");
    refusal({"measure", squaresScene(), "--csv", file + "/x.csv"}, "cannot make this folder");
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"taken"});
}

TEST_CASE("what is no file is neither waited for nor replaced", "[cli][signals]") {
    const Scratch scratch;
    const std::string fifo = scratch.path("fifo.json"), link = scratch.path("null.csv");
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    for (const char* command : {"run", "check", "explain", "measure"})
        CHECK_THAT(runShoal({command, fifo}).err, Catch::Contains("fifo.json: is a FIFO, expected a file"));
    const Words words{"run", squaresScene(), "--headless", "--frames", "1"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), words.begin(), words.end());
        return more;
    };
    refusal(with({"--resume", fifo}), "is a FIFO, expected a file");
    refusal(with({"--save", fifo}), "fifo.json: cannot be written: nobody reads there");
    std::filesystem::create_symlink("/dev/null", link);
    CHECK(runShoal(with({"--save", link, "--export", link})).code == 0);
    CHECK(std::filesystem::is_symlink(link));
    CHECK(std::filesystem::is_character_file("/dev/null"));
    std::filesystem::create_symlink("/dev/null", scratch.path("null.mp4"));
    if (hasFfmpeg())
        refusal(with({"--capture", scratch.path("null.mp4")}), "is a device, expected a file to write");
}

TEST_CASE("Ctrl-C leaves a whole stage of clips", "[cli][signals]") {
    const Scratch scratch;
    const auto exporting = [&](const Words& more) {
        Words out{"export", squaresScene(), "--frames", "8000"};
        out.insert(out.end(), more.begin(), more.end());
        return out;
    };
    StartedShoal usd(exporting({"--usd", scratch.path("clips")}));
    usd.waitForFile(scratch.path("clips/frames/clips-00003.usda"));
    usd.send(SIGINT);
    const Outcome stage = usd.finish();
    INFO(stage.err);
    CHECK(stage.signal == SIGINT);
    const int last = stoppedAfter(stage);
    CHECK_THAT(stage.err, Catch::Contains("shoal: stopped by signal 2 (Interrupt) after frame") &&
                              Catch::Contains("clips.usda ends there"));
    const std::string text = readFile(scratch.path("clips/clips.usda"));
    CHECK_THAT(text, Catch::Contains(concat("endTimeCode = ", last - 1, "\n")));
    CHECK(filesIn(scratch.path("clips/frames")).size() == size_t(last) + 1);  // and what they hold
}

TEST_CASE("Ctrl-C leaves nothing of an animation texture", "[cli][signals]") {
    const Scratch scratch;
    StartedShoal started(
        {"export", squaresScene(), "--frames", "8000", "--substeps", "64", "--vat", scratch.path("vat")});
    started.waitForError(" of 8000");
    started.send(SIGINT);
    const Outcome outcome = started.finish();
    INFO(outcome.err);
    CHECK(outcome.signal == SIGINT);
    CHECK(stoppedAfter(outcome) < 8000);
    CHECK_THAT(outcome.err, Catch::Contains("; nothing is written"));
    CHECK_FALSE(std::filesystem::exists(scratch.path("vat")));
}

TEST_CASE("whatever is stopped says so in one line", "[cli][signals]") {
    const Scratch scratch;
    StartedShoal bench({"bench", "--quick"}, {.folder = scratch.folder().string()});
    bench.waitForError(" s.\n");
    bench.send(SIGTERM);
    const Outcome outcome = bench.finish();
    INFO(outcome.out << outcome.err);
    CHECK(outcome.signal == SIGTERM);
    CHECK(outcome.messages() ==
          std::vector<std::string>{"shoal: stopped by signal 15; what was not whole is removed"});
    CHECK(filesIn(scratch.path("")).empty());
}
