// The GPU keeps the state: after start-up a frame moves no byte of it, and at most 256 bytes of control.
#include "gl/gl_test.h"
#include "render/renderer.h"
#include "scene/json/scene_file.h"
#include "simulate/simulation.h"
#include "support/catch.h"

using namespace shoal;
using Kind = gpu::Traffic::Kind;

static gpu::Traffic trafficOfFrames(gpu::PassTimers::Mode timing, int frames) {
    const Scene scene = readScene(SHOAL_SOURCE_DIR "/models/hello/hello.scene.json");
    const Plan plan = compile(scene);
    Simulation simulation(testContext(), plan, {.drawn = true, .timing = timing, .path = testPath()});
    RenderOptions size;
    size.width = 160;
    size.height = 90;
    size.shadowSize = 256;
    Renderer renderer(testContext(), scene, plan, size);
    const gpu::Traffic before = testContext().traffic();
    REQUIRE(before.up(Kind::state) > 0);  // the start state did cross, so the counter counts
    for (int i = 0; i < frames; ++i) {
        simulation.frame();
        renderer.draw(simulation.state(), View::fromCamera(scene.camera));
    }
    return testContext().traffic() - before;
}

TEST_CASE("simulating and drawing a frame moves no state over the bus", "[traffic]") {
    const gpu::Traffic traffic = trafficOfFrames(gpu::PassTimers::Mode::off, 5);
    CHECK(traffic.total(Kind::state) == 0);
    CHECK(traffic.total(Kind::parameters) == 0);
    CHECK(traffic.total(Kind::control) == 4 * 4);  // the watchdog's word of all frames but the last
}

TEST_CASE("timing passes with queries stays within the control bytes", "[traffic]") {
    const gpu::Traffic traffic = trafficOfFrames(gpu::PassTimers::Mode::query, 12);
    CHECK(traffic.total(Kind::state) == 0);
    CHECK(traffic.total(Kind::control) > 0);
    CHECK(traffic.total(Kind::control) <= 12 * gpu::Traffic::controlBytesPerFrame);
}

TEST_CASE("reading a snapshot is counted as state", "[traffic]") {
    const Plan plan = compile(readScene(SHOAL_SOURCE_DIR "/models/hello/hello.scene.json"));
    Simulation simulation(testContext(), plan, {.path = testPath()});
    const gpu::Traffic before = testContext().traffic();
    simulation.snapshot(0);
    CHECK((testContext().traffic() - before).down(Kind::state) > 0);
}
