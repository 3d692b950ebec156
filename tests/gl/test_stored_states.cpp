// What `shoal bench --report` compares with: the states and pictures in models/golden.
//
// SHOAL_UPDATE_GOLDEN=1 writes them anew: "[.golden-states]". Look at the pictures before they are committed.
#include <cstdlib>
#include <filesystem>

#include "bench/bench.h"
#include "bench/device_checks.h"
#include "core/file.h"
#include "gl/gl_test.h"
#include "gl/render_scene.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::bench;

namespace {

const std::string models = SHOAL_SOURCE_DIR "/models", molecules = SHOAL_SOURCE_DIR "/molecules";

std::vector<NamedFile> sceneFiles() {
    std::vector<NamedFile> out;
    const std::string ending = ".scene.json";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
        const std::string path = entry.path().string();
        if (!path.ends_with(ending)) continue;
        const std::string name = entry.path().lexically_relative(models).generic_string();
        out.emplace_back(name.substr(0, name.size() - ending.size()), path);
    }
    std::sort(out.begin(), out.end());
    return out;
}

BenchDevice deviceHere() {
    BenchDevice out;
    out.context = &testContext();
    return out;
}

Image draw(const Scene& scene, const Simulation& simulation) {
    Renderer renderer(testContext(), scene, simulation.plan(),
                      {.width = blockColumns * blockSide, .height = blockRows * blockSide});
    renderer.draw(simulation.state(), View::fromCamera(scene.camera, simulation.time()));
    return renderer.capture();
}

}  // namespace

TEST_CASE("the stored states and pictures are made", "[.golden-states]") {
    if (std::getenv("SHOAL_UPDATE_GOLDEN") == nullptr) {
        WARN("skipped: SHOAL_UPDATE_GOLDEN is not set");
        return;
    }
    StoredStates stored;
    Image sheet{blockColumns, 0, 4, {}};
    const auto record = [&](const std::string& name, const Scene& scene, int frames) {
        WARN(name);
        stored.states.push_back(recordState(name, scene, frames, deviceHere()));
    };
    for (const auto& [name, scene] : solverScenes(molecules))
        record(name, scene, solverFrames);
    for (const auto& [name, file] : sceneFiles()) {
        const Scene scene = checkedScene(file);
        record(name, scene, checkedFrames);
        const Image blocks = recordPicture(scene, deviceHere(), draw);
        sheet.pixels.insert(sheet.pixels.end(), blocks.pixels.begin(), blocks.pixels.end());
        sheet.height += blocks.height;
        stored.pictures.push_back(name);
    }
    writeFile(models + "/golden/states.json", writeJson(asJson(stored)));
    writePng(models + "/golden/pictures.png", sheet);
}

TEST_CASE("every scene that ships and every solver has a stored state, and every scene a picture",
          "[stored-states]") {
    const StoredStates stored = readStoredStates(models + "/golden/states.json");
    const Image sheet = readPng(models + "/golden/pictures.png");
    CHECK(sheet.width == blockColumns);
    CHECK(sheet.height == int(stored.pictures.size()) * blockRows);
    CHECK(stored.states.size() == sceneFiles().size() + solvers().size());
    for (const auto& [name, file] : sceneFiles()) {
        INFO(name);
        CHECK(stored.find(name) != nullptr);
        CHECK(std::count(stored.pictures.begin(), stored.pictures.end(), name) == 1);
    }
    for (const auto& [name, scene] : solverScenes(molecules))
        CHECK(stored.find(name) != nullptr);
}

TEST_CASE("a stored state holds where it was made, and not after a wrong step", "[stored-states]") {
    const StoredStates stored = readStoredStates(models + "/golden/states.json");
    const std::string hello = "hello/hello";
    const StoredState& state = *stored.find(hello);
    const Scene scene = checkedScene(models + "/hello/hello.scene.json");
    const BenchDevice device = deviceHere();
    Simulation simulation(testContext(), compile(scene), {.drawn = false});
    const auto worst = [&](double gravity) {
        simulation.restart();
        simulation.parameters.gravity.y = gravity;
        for (int i = 0; i < state.frames; ++i)
            simulation.frame();
        return mismatch(simulation, state.groups[0], 0);
    };
    const Mismatch right = worst(-9.81), wrong = worst(-9.76);
    INFO(right.worst << "; " << wrong.worst);
    CHECK(right.ofTolerance < 1);
    CHECK(wrong.ofTolerance > 1);

    const Image blocks = recordPicture(scene, device, draw), sheet = readPng(models + "/golden/pictures.png");
    const auto row =
        std::find(stored.pictures.begin(), stored.pictures.end(), hello) - stored.pictures.begin();
    CHECK(pictureMismatch(blocks, sheet, int(row)).ofTolerance < 1);
    CHECK(pictureMismatch(blocks, sheet, int(row) + 1).ofTolerance > 1);
    CHECK(pictureMismatch(blocks, sheet, 1000).ofTolerance > 1);
}

TEST_CASE("a check that fails is a row with its words, and a lost device ends the checks",
          "[stored-states]") {
    const auto check = [](std::function<Mismatch()> work) {
        return runCheck({"state", "one", std::move(work)}, testContext());
    };
    CHECK(check([] { return Mismatch{0.5, "x"}; }).held());
    CHECK_FALSE(check([] { return Mismatch{1.5, "x"}; }).held());
    const DeviceCheckResult failed =
        check([]() -> Mismatch { throw Error("shaders/a.glsl:3: no such name"); });
    CHECK(failed.failed == "shaders/a.glsl:3: no such name");
    CHECK_FALSE(failed.held());
    const DeviceCheckResult leftOut = check([]() -> Mismatch { throw LeftOut("needs OpenGL 4.3"); });
    CHECK(leftOut.leftOut == "needs OpenGL 4.3");
    CHECK(leftOut.failed.empty());

    if (!testContext().info().atLeast(4, 5)) return;
    const auto before = __glewGetGraphicsResetStatus;
    __glewGetGraphicsResetStatus = []() -> GLenum { return GL_INNOCENT_CONTEXT_RESET; };
    std::string words;
    try {
        check([] { return Mismatch{0.5, "x"}; });
    } catch (const gpu::DeviceLost& lost) {
        words = lost.message();
    }
    __glewGetGraphicsResetStatus = before;
    CHECK(words == "the device was lost: the driver reset it, for what another program did");
}

TEST_CASE("the bench takes the device's own time of what runs on it, and none of what does not",
          "[stored-states]") {
    const BenchMolecules all(molecules);
    BenchDevice device = deviceHere();
    device.ownTimes = true;  // here of a rasteriser: plausible, if not right
    BenchCase one;
    one.group = "64 quads";
    one.molecule = "quad";
    one.count = 64;
    one.subject = Subject::pingPong;
    BenchCase scalar = one;
    scalar.subject = Subject::scalar;
    const std::vector<BenchResult> results =
        measureGroup({one, scalar}, all, device, {.seconds = 0.01}, [](double) {});
    CHECK(results[0].device.samples == results[0].frame.samples);
    CHECK(results[0].device.min > 0);
    CHECK(results[1].device.samples == 0);
}
