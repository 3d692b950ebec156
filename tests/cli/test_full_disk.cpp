// A disk that is full and places that cannot be written: one message, a failing exit code, nothing
// half-written. A limit on the size of files stands in for the disk: a write beyond it fails in the same way.
#include <cstdlib>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words words(const std::string& option, const std::string& target) {
    return {"run", squaresScene(), "--headless", "--size", "160x90", "--frames", "2", option, target};
}

Surroundings almostFull() {
    Surroundings out;
    out.largestFile = 2048;
    // the driver's cache of shaders is a file, too
    out.environment = {{"MESA_SHADER_CACHE_DISABLE", "true"}, {"MESA_GLSL_CACHE_DISABLE", "true"}};
    return out;
}

}  // namespace

TEST_CASE("a full disk stops a run cleanly", "[cli]") {
    const Scratch scratch;
    refusal(words("--capture", scratch.path("pictures")),
            "frame-00001.png: cannot be written: ", almostFull());
    refusal(words("--export", scratch.path("x.csv")), "x.csv: cannot be written: File too large",
            almostFull());
    refusal(words("--export", scratch.path("x.ply")), "x.ply: cannot be written: File too large",
            almostFull());
    CHECK(filesIn(scratch.path("")).empty());
}

TEST_CASE("a full disk leaves the old file as it was", "[cli]") {
    const Scratch scratch;
    scratch.write("x.csv", "old");
    refusal(words("--export", scratch.path("x.csv")), "cannot be written", almostFull());
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"x.csv"});
    CHECK(readFile(scratch.path("x.csv")) == "old");
}

TEST_CASE("a full disk stops a video cleanly", "[cli]") {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    const Scratch scratch;
    Surroundings tight = almostFull();
    tight.largestFile = 500;
    refusal(words("--capture", scratch.path("out.mp4")), "out.mp4: ffmpeg", tight);
    CHECK(filesIn(scratch.path("")).empty());
}

TEST_CASE("a target that is something else is refused", "[cli]") {
    const Scratch scratch;
    const std::string file = scratch.write("taken", "old");
    refusal(words("--capture", file), "taken");
    refusal(words("--capture", file + "/below"), "taken/below");
    refusal(words("--capture", file + "/video.mp4"), "taken");
    refusal(words("--export", file), "taken");
    refusal(words("--export", file + "/x.csv"), "taken: cannot make this folder");
    CHECK(readFile(file) == "old");
    std::filesystem::create_directory(scratch.path("folder.csv"));
    refusal(words("--export", scratch.path("folder.csv")), "is a folder, expected a file to write");
    refusal(words("--capture", scratch.path("a-%d-%d.png")), "expected one frame number");
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"taken"});
}
