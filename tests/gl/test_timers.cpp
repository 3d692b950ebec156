#include <chrono>
#include <sstream>
#include <string>
#include <thread>

#include <imgui.h>

#include "gl/gl_test.h"
#include "gl/render_scene.h"
#include "gpu/frame_record.h"
#include "gpu/gl.h"
#include "gpu/pass_timers.h"
#include "support/catch.h"
#include "window/panel.h"

using namespace shoal::gpu;
using Kind = Traffic::Kind;
using Mode = PassTimers::Mode;

static void pause(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

// A stage counts where it has passes.
static void pass() {
    FrameRecord::add("pass", {}, {}, {}, {});
}

TEST_CASE("finish mode adds up the calls of a frame", "[timers]") {
    PassTimers timers(testContext(), Mode::finish);
    double whole = 0;  // s, of the last frame
    for (int frame = 0; frame < 3; ++frame) {
        const auto begin = std::chrono::steady_clock::now();
        timers.beginFrame();
        for (int call = 0; call < 2; ++call) {
            auto t = timers.time("slow");
            pass();
            pause(4);
        }
        {
            auto t = timers.time("quick");
            pass();
        }
        { auto t = timers.time("without passes"); }
        timers.endFrame();
        whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    const auto report = timers.report();
    REQUIRE(report.size() == 2);
    CHECK(report[0].name == "slow");
    CHECK(report[0].calls == 2);
    CHECK(report[0].frames == 3);
    CHECK(report[0].min >= 0.008);
    CHECK(report[0].median >= report[0].min);
    CHECK(report[1].calls == 1);
    CHECK(report[0].last + report[1].last <= whole);  // nothing is counted twice
    CHECK(report[0].values.size() == 3);
    CHECK(report[0].values.back() == report[0].last);
    timers.reset();
    CHECK(timers.report()[0].values.empty());
}

TEST_CASE("queries give every pass a value within the control bytes", "[timers]") {
    for (const int calls : {1, 24, 25, 100}) {
        INFO(calls << " calls a frame");
        PassTimers timers(testContext(), Mode::query);
        uint64_t most = 0;
        for (int frame = 0; frame < 40; ++frame) {
            const Traffic before = testContext().traffic();
            timers.beginFrame();
            for (int call = 0; call < calls; ++call) {
                auto t = timers.time(("pass " + std::to_string(call % 10)).c_str());
                pass();
                glFlush();
            }
            { auto t = timers.time("without passes"); }
            timers.endFrame();
            glFinish();
            const Traffic moved = testContext().traffic() - before;
            most = std::max(most, moved.total(Kind::control));
            CHECK(moved.total(Kind::state) == 0);
        }
        CHECK(most > 0);
        CHECK(most <= Traffic::controlBytesPerFrame);
        timers.drain();
        const auto report = timers.report();
        CHECK(report.size() == static_cast<size_t>(std::min(calls, 10)));
        int total = 0;
        for (const PassTime& pass : report) {
            CHECK(pass.frames > 0);
            CHECK(pass.min >= 0.0);
            total += pass.calls;
        }
        CHECK(total == calls);
    }
    testContext().checkErrors("queries");
}

TEST_CASE("timers that are off, and calls outside a frame, cost nothing", "[timers]") {
    PassTimers off(testContext(), Mode::off);
    const Traffic before = testContext().traffic();
    off.beginFrame();
    {
        auto t = off.time("pass");
        pass();
    }
    off.endFrame();
    CHECK(off.report().empty());
    PassTimers on(testContext(), Mode::query);
    {
        auto t = on.time("outside");
        pass();
    }
    on.drain();
    CHECK(on.report().empty());
    const Traffic moved = testContext().traffic() - before;
    CHECK(moved.total(Kind::control) == 0);
    testContext().checkErrors("timers that are off");
}

TEST_CASE("the window's panel lists the stages that run --timings and bench --report have", "[timers]") {
    using namespace shoal;
    Scene scene = test::sceneOfSquares({{0, 0, 0}});
    scene.colliders.emplace_back();  // a ground, for shadows
    Simulation simulation(testContext(), compile(scene), {.timing = Mode::finish, .path = testPath()});
    Renderer renderer(testContext(), scene, simulation.plan(),
                      {.width = 64, .height = 36, .timing = Mode::finish});
    simulation.frame();
    renderer.draw(simulation.state(), View::fromCamera(scene.camera));
    const std::vector<PassTime> stages = stagesOf(simulation.timers(), &renderer.timers());
    CHECK(stages.size() > 5);

    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = ImVec2(600, 2000);
    io.Fonts->Build();
    std::string shown;
    io.ClipboardUserData = &shown;
    io.SetClipboardTextFn = [](void* text, const char* words) { *static_cast<std::string*>(text) = words; };
    ImGui::NewFrame();
    ImGui::SetNextWindowSize(io.DisplaySize);
    ImGui::Begin("panel");
    ImGui::LogToClipboard();
    window::drawTimes(simulation.timers(), renderer.timers());
    ImGui::LogFinish();
    ImGui::End();
    ImGui::Render();
    ImGui::DestroyContext();
    INFO(shown);
    std::istringstream lines(shown);
    std::string line;
    std::getline(lines, line);  // the heads
    for (const PassTime& stage : stages) {
        std::getline(lines, line);
        CHECK_THAT(line, Catch::Contains(concat("| ", stage.name, " |")));
    }
    CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("values are those of the newest frames, oldest first", "[timers]") {
    PassTimers timers(testContext(), Mode::finish);
    for (int frame = 0; frame < PassTimers::keptFrames + 5; ++frame) {
        timers.beginFrame();
        {
            auto t = timers.time("pass");
            pass();
        }
        timers.endFrame();
    }
    const PassTime report = timers.report().front();
    CHECK(report.values.size() == static_cast<size_t>(PassTimers::keptFrames));
    CHECK(report.values.back() == report.last);
    CHECK(report.frames == PassTimers::keptFrames + 5);
}
