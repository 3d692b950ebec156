// Equal groups share their programs, and names of any length are labels.
#include <string>

#include "compile/plan.h"
#include "gl/gl_test.h"
#include "gpu/gl.h"
#include "gpu/program_cache.h"
#include "gpu/texture.h"
#include "render/renderer.h"
#include "scene/json/scene_file.h"
#include "simulate/simulation.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using shoal::test::Scratch;

namespace {

// Squares over a plane, each group under its own name and at its own height.
Scene groups(int count, const std::string& name) {
    std::string text =
        R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0], "solver": {"method": "leapfrog"},
        "colliders": [{"type": "plane"}], "groups": [)";
    for (int g = 0; g < count; ++g)
        text += concat(g == 0 ? "" : ",", R"({"molecule": "../../molecules/quad.json", "name": ")", name, g,
                       R"(", "count": 3, "place": {"on": "volume", "box": {"low": [0, )", 0.2 + g,
                       R"(, 0], "high": [1, )", 0.3 + g, R"(, 1]}}})");
    return parseScene(text + "]}", SHOAL_SOURCE_DIR "/models/hello/groups.scene.json");
}

}  // namespace

TEST_CASE("Equal groups compile once, and each moves by itself", "[fused][numerics]") {
    const Scratch scratch;
    const auto run = [&](const Scene& scene, const char* folder, int& made) {
        const gpu::OtherCache kept(testContext(), scratch.path(folder));
        SimulationOptions options;
        options.path = testPath();
        Simulation simulation(testContext(), compile(scene), options);
        for (int i = 0; i < 20; ++i)
            simulation.frame();
        made = testContext().cache().misses() + testContext().cache().hits();
        return simulation.snapshot(0).positions;
    };
    int one = 0, many = 0;
    const auto alone = run(groups(1, "a"), "one", one);
    const auto beside = run(groups(12, "a"), "many", many);
    CHECK(many == one);
    CHECK(alone == beside);

    Scene other = groups(2, "a");  // what the second meets is not what the first does
    other.groups[1].place.box = other.groups[0].place.box;
    other.groups[1].surface = other.colliders[0].surface = "ice";
    other.surfacePairs.push_back({"ice", "ice", 1.0, 0.0});
    int both = 0;
    CHECK(run(other, "other", both) == alone);
}

TEST_CASE("A group's name may be as long as it likes", "[fused][render]") {
    const std::string name(300, 'g'), wide = name + std::string(100, '\xC3') + "\xA4";
    Scene scene = groups(2, name);
    Simulation simulation(testContext(), compile(scene), {});
    simulation.frame();
    RenderOptions options;
    options.width = options.height = 32;
    Renderer renderer(testContext(), scene, simulation.plan(), options);
    renderer.draw(simulation.state(), View::fromCamera(scene.camera, 0));
    {
        const gpu::DebugGroup group(testContext().info(), wide.c_str());
        gpu::Texture texture(testContext(), gpu::Format::rgba8, 1, 1, wide.c_str());
    }
    CHECK_NOTHROW(testContext().checkErrors("long names"));
}
