// Captures for compositors: pictures and videos without a sky, and .exr files with light, depth and masks.
#include <map>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

constexpr int width = 64, height = 48;

// A ball of 0.5 m in the middle, 3 m from the eye, and a wall of one molecule before its upper right.
std::string ballAndQuad(const Scratch& scratch) {
    scratch.write("wall.json", R"({"format": "shoal-molecule-1", "name": "wall",
        "vertices": [{"position": [0, 0, 0], "mass": 1}, {"position": [1, 0, 0], "mass": 1},
                     {"position": [1, 1, 0], "mass": 1}, {"position": [0, 1, 0], "mass": 1}],
        "defaults": {"stiffness": 100}, "springs": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}],
        "triangles": [[0, 1, 2], [0, 2, 3]]})");
    return scratch.write("a.scene.json", R"({"format": "shoal-scene-1",
        "colliders": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.5}],
        "groups": [{"name": "the wall", "molecule": "wall.json", "collide": false,
                    "place": {"on": "list", "items": [{"position": [0, 0, 1]}]}}],
        "camera": {"eye": [0, 0, 3], "target": [0, 0, 0]}})");
}

void capture(const std::string& scene, const std::string& target, const Words& more = {}) {
    Words words{"run", scene, "--headless", "--frames", "1", "--size", "64x48", "--capture", target};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome out = runShoal(words);
    INFO(out.err);
    REQUIRE(out.code == 0);
}

// Every channel of a file, rows from the top.
std::map<std::string, std::vector<float>> channelsOf(const std::string& name) {
    Imf::InputFile file(name.c_str());
    std::map<std::string, std::vector<float>> out;
    Imf::FrameBuffer buffer;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        std::vector<float>& values = out[channel.name()];
        values.resize(size_t(width * height));
        buffer.insert(channel.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()),
                                                 sizeof(float), sizeof(float) * size_t(width)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(0, height - 1);
    return out;
}

size_t pixelAt(int x, int y) {
    return size_t(y * width + x);
}

}  // namespace

TEST_CASE("a picture without a sky is clear where nothing is", "[cli][layers]") {
    const Scratch scratch;
    const std::string file = scratch.path("a.png");
    capture(ballAndQuad(scratch), file, {"--transparent"});
    const Image image = readPng(file);
    const auto alpha = [&](int x, int y) { return int(image.pixels[4 * pixelAt(x, y) + 3]); };
    CHECK((alpha(2, 2) == 0 && alpha(60, 44) == 0));
    CHECK((alpha(width / 2 - 3, height / 2 + 3) == 255 && alpha(width / 2 + 3, height / 2 - 3) == 255));
    size_t edges = 0;
    for (size_t i = 3; i < image.pixels.size(); i += 4)
        edges += image.pixels[i] > 0 && image.pixels[i] < 255;
    CHECK(edges > 10);  // which are smooth
    CHECK((image.pixels[0] == 0 && image.pixels[1] == 0 && image.pixels[2] == 0));

    capture(scratch.path("a.scene.json"), file);
    const Image whole = readPng(file);
    for (size_t i = 3; i < whole.pixels.size(); i += 4)
        REQUIRE(whole.pixels[i] == 255);
}

TEST_CASE("an .exr file has light, depth in metres and a mask of each group", "[cli][layers]") {
    const Scratch scratch;
    const std::string file = scratch.path("a.exr");
    capture(ballAndQuad(scratch), file, {"--transparent"});
    auto channels = channelsOf(file);
    std::vector<std::string> names;
    for (const auto& [name, values] : channels)
        names.push_back(name);
    CHECK(names == std::vector<std::string>{"A", "B", "G", "R", "Z", "mask.the_wall"});
    const size_t ball = pixelAt(width / 2 - 3, height / 2 + 3), wall = pixelAt(width / 2 + 6, height / 2 - 6),
                 sky = pixelAt(2, 2);
    const std::vector<float>&alpha = channels["A"], &depth = channels["Z"], &mask = channels["mask.the_wall"];
    CHECK((alpha[ball] == 1 && alpha[wall] == 1 && alpha[sky] == 0));
    CHECK((mask[ball] == 0 && mask[wall] == 1 && mask[sky] == 0));
    CHECK(depth[ball] == Approx(2.53).margin(0.06));
    CHECK(depth[wall] == Approx(2).margin(0.01));
    CHECK(depth[sky] == 1e10f);
    for (size_t i = 0; i < alpha.size(); ++i) {
        CHECK(mask[i] <= alpha[i] + 0.01f);
        if (alpha[i] == 0) CHECK((channels["R"][i] == 0 && channels["G"][i] == 0 && channels["B"][i] == 0));
    }
    CHECK(channels["R"][wall] > 0.05f);
}

TEST_CASE("videos have alpha where their kind does", "[cli][layers]") {
    const Scratch scratch;
    const std::string scene = ballAndQuad(scratch);
    refusal({"run", scene, "--headless", "--capture", scratch.path("a.mp4"), "--transparent"},
            "--transparent: .mp4 has no alpha; .mov (ProRes 4444), .webm (VP9), .png and .exr have");
    refusal({"run", scene, "--headless", "--transparent"}, "--transparent requires --capture");
    refusal({"run", "reef/school", "--headless", "--frames", "1", "--transparent", "--capture",
             scratch.path("a.png")},
            "--transparent: the water of this scene fills the picture");
    const std::string ffmpeg = findProgram("ffmpeg");
    if (ffmpeg.empty()) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    for (const std::string ending : {".mov", ".webm"}) {
        const std::string video = scratch.path("a" + ending), picture = scratch.path("a.png");
        capture(scene, video, {"--transparent"});
        Words words{"-loglevel", "error", "-y"};
        if (ending == ".webm")
            words.insert(words.end(), {"-c:v", "libvpx-vp9"});  // its own decoder drops alpha
        words.insert(words.end(), {"-i", video, "-pix_fmt", "rgba", picture});
        const Outcome decoded = runProgram(ffmpeg, words);
        INFO(ending << ": " << decoded.err);
        REQUIRE(decoded.code == 0);
        const Image image = readPng(picture);
        CHECK(int(image.pixels[4 * pixelAt(2, 2) + 3]) < 8);
        CHECK(int(image.pixels[4 * pixelAt(width / 2, height / 2) + 3]) > 247);
    }
}
