// `shoal bench --report FILE`: all that is to be known of a device, in one JSON file, without anybody
// watching.
//
// Checks (bench/device_checks.h and pictures), the cases of `shoal bench`, then every scene that ships, drawn
// at two sizes. What fails is a row with the driver's words, and the next one goes on; only a lost device
// ends it. The file is written at the end, whole or not at all.
#include <iostream>
#include <memory>
#include <optional>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "app/line/commit.h"
#include "bench/device_checks.h"
#include "core/data_paths.h"
#include "core/file.h"
#include "core/printable.h"
#include "gpu/gl.h"
#include "render/renderer.h"
#include "run/scene_list.h"
#include "run/signals.h"
#include "scene/json/scene_file.h"

namespace shoal::app {

using namespace bench;

namespace {

constexpr double secondsAGroup = 2, quickSecondsAGroup = 0.5;
constexpr double patience = 0.5;  // s: what takes longer is timed once (measure::Schedule)

// One scene, simulated and drawn at one size, s a frame: wall times of both, and the device's own.
struct DrawnTimes {
    std::string scene;
    int width = 0, height = 0;
    std::string failed;  // the words of an error; empty: none
    size_t molecules = 0;
    measure::Spread simulate = {}, draw = {}, deviceSimulate = {}, deviceDraw = {};
    std::vector<gpu::PassTime> stages = {};
};

struct DeviceReport {
    std::string date;  // UTC
    std::vector<DeviceCheckResult> checks;
    std::optional<BenchReport> speeds;
    std::vector<DrawnTimes> drawn;
    double seconds = 0;
};

struct Files {
    std::string states = modelFolder() + "/golden/states.json",
                pictures = modelFolder() + "/golden/pictures.png";
};

Mismatch pictureOf(const NamedFile& scene, const StoredStates& stored, const Image& sheet,
                   const BenchDevice& device) {
    const auto row = std::find(stored.pictures.begin(), stored.pictures.end(), scene.first);
    if (row == stored.pictures.end()) throw Error("no picture of it is stored (docs/testing.md)");
    const PictureMaker draw = [&](const Scene& drawn, const Simulation& simulation) {
        Renderer renderer(*device.context, drawn, simulation.plan(),
                          {.width = blockColumns * blockSide, .height = blockRows * blockSide});
        renderer.draw(simulation.state(), View::fromCamera(drawn.camera, simulation.time()));
        return renderer.capture();
    };
    const Image blocks = recordPicture(checkedScene(scene.second), device, draw);
    return pictureMismatch(blocks, sheet, int(row - stored.pictures.begin()));
}

std::vector<DeviceCheck> wantedChecks(const Options& options, const std::vector<NamedFile>& scenes,
                                      const StoredStates& stored, const Image& sheet,
                                      const BenchDevice& device) {
    std::vector<DeviceCheck> out = deviceChecks(scenes, moleculeFolder(), stored, device);
    for (const NamedFile& scene : scenes)
        out.push_back({"picture", scene.first, [&] { return pictureOf(scene, stored, sheet, device); }});
    std::erase_if(
        out, [&](const DeviceCheck& check) { return check.title().find(options.only) == std::string::npos; });
    return out;
}

// A scene that goes on from one size to the next.
class DrawnScene {
  public:
    DrawnScene(const NamedFile& file, const BenchDevice& device)
        : device_(device),
          scene_(readScene(file.second)),
          simulation_(*device.context, compile(scene_), {}) {}

    // Draws one frame to make all that is needed, then measures frames until there are enough, or time is up.
    void measure(DrawnTimes& out, bool quick) {
        renderer_.emplace(*device_.context, scene_, simulation_.plan(),
                          RenderOptions{.width = out.width, .height = out.height});
        frame();
        simulate_.clear(), draw_.clear(), ownSimulate_.clear(), ownDraw_.clear();
        const double seconds = quick ? 0.2 : patience;
        repeat(seconds);
        for (const GroupPlan& group : simulation_.plan().groups)
            out.molecules += size_t(group.count);
        out.simulate = measure::spreadOf(simulate_);
        out.draw = measure::spreadOf(draw_);
        out.deviceSimulate = measure::spreadOf(ownSimulate_);
        out.deviceDraw = measure::spreadOf(ownDraw_);
        out.stages = stages(seconds);
        simulation_.check();
        device_.context->checkErrors("drawn");
    }

  private:
    static constexpr size_t most = 60;

    void repeat(double seconds) {
        const auto start = measure::Clock::now();
        for (size_t i = 0; i < most && (i == 0 || measure::secondsSince(start) < seconds); ++i)
            frame();
    }

    // Frames of their own, because timers wait for each stage on a CPU rasteriser.
    std::vector<gpu::PassTime> stages(double seconds) {
        gpu::PassTimers &simulating = simulation_.timers(), &drawing = renderer_->timers();
        const auto setMode = [&](gpu::PassTimers::Mode mode) {
            simulating.setMode(mode);
            drawing.setMode(mode);
        };
        simulating.reset();  // of what another size has measured
        setMode(gpu::PassTimers::suitedTo(device_.context->info()));
        repeat(seconds);
        setMode(gpu::PassTimers::Mode::off);
        return gpu::stagesOf(simulating, &drawing);
    }

    template <typename Work>
    void take(std::vector<double>& wall, std::vector<double>& own, const Work& work) {
        wall.push_back(measure::secondsOf([&] {
            if (device_.ownTimes)
                own.push_back(timer_.secondsOf(work));
            else
                work();
            glFinish();
        }));
    }
    void frame() {
        take(simulate_, ownSimulate_, [&] { simulation_.frame(); });
        take(draw_, ownDraw_, [&] {
            renderer_->draw(simulation_.state(), View::fromCamera(scene_.camera, simulation_.time()));
        });
    }

    const BenchDevice& device_;
    Scene scene_;
    Simulation simulation_;
    std::optional<Renderer> renderer_;
    gpu::DeviceTimer timer_;
    std::vector<double> simulate_, draw_, ownSimulate_, ownDraw_;  // s
};

std::vector<DrawnTimes> wantedPictures(const Options& options, const std::vector<NamedFile>& scenes) {
    std::vector<DrawnTimes> out;
    for (const NamedFile& scene : scenes)
        for (const auto& [width, height] : {std::pair(1280, 720), std::pair(1920, 1080)})
            if (concat("drawn: ", scene.first).find(options.only) != std::string::npos)
                out.push_back({scene.first, width, height, {}, 0});
    if (options.quick) std::erase_if(out, [](const DrawnTimes& times) { return times.width > 1280; });
    return out;
}

void measureDrawn(const Options& options, const std::vector<NamedFile>& scenes, const BenchDevice& device,
                  std::vector<DrawnTimes>& drawn) {
    if (drawn.empty()) return;
    Progress progress("drawn scenes", int(drawn.size()));
    std::unique_ptr<DrawnScene> scene;
    std::string loaded;  // the name of it
    for (DrawnTimes& times : drawn) {
        if (signalThatAsked()) return;
        try {
            if (!scene || loaded != times.scene) {
                const auto file = std::find_if(scenes.begin(), scenes.end(), [&](const NamedFile& candidate) {
                    return candidate.first == times.scene;
                });
                scene.reset();
                scene = std::make_unique<DrawnScene>(*file, device);
                loaded = times.scene;
            }
            scene->measure(times, options.quick);
        } catch (const std::exception& error) {
            times.failed = error.what();
            scene.reset();
        }
        device.context->checkAlive();
        progress.step();
    }
}

// ---- The file

JsonValue asJson(const DeviceCheckResult& check) {
    JsonValue out = object(key("kind", check.kind), key("name", check.name), key("held", check.held()));
    if (!check.leftOut.empty()) return append(out, key("leftOut", check.leftOut));
    if (!check.failed.empty()) return append(out, key("failed", check.failed));
    return append(out, key("ofTolerance", check.mismatch.ofTolerance), key("worst", check.mismatch.worst),
                  key("seconds", check.seconds));
}

JsonValue asJson(const measure::Spread& wall, const measure::Spread& own) {
    JsonValue out = object(key("minSeconds", wall.min), key("medianSeconds", wall.median));
    appendDeviceTime(out, own);
    return out;
}

JsonValue asJson(const DrawnTimes& times) {
    JsonValue out = object(key("scene", times.scene), key("width", times.width), key("height", times.height));
    if (!times.failed.empty()) return append(out, key("failed", times.failed));
    return append(out, key("molecules", times.molecules), key("frames", times.simulate.samples),
                  key("simulate", asJson(times.simulate, times.deviceSimulate)),
                  key("draw", asJson(times.draw, times.deviceDraw)),
                  key("stages", arrayOf(times.stages, bench::asJson)));
}

JsonValue asJson(const DeviceReport& report, const MeasuredOn& machine, bool quick) {
    JsonValue out = object(key("format", "shoal-device-1"), key("version", SHOAL_VERSION),
                           key("commit", commit()), key("date", report.date));
    const JsonValue device =
        object(key("processor", machine.processor), key("cores", machine.cores),
               key("kind", gpu::name(machine.context.kind)), key("platform", machine.context.platform),
               key("vendor", machine.context.vendor), key("renderer", machine.context.renderer),
               key("openGL", machine.context.version), key("glsl", machine.context.glslVersion),
               key("software", machine.context.software));
    append(out, key("machine", device), key("quick", quick), key("seconds", report.seconds),
           key("checks", arrayOf(report.checks, asJson)));
    if (report.speeds) append(out, key("speeds", asJson(*report.speeds)));
    return append(out, key("drawn", arrayOf(report.drawn, asJson)));
}

// ---- For people

// A line for each check that did not hold or failed.
std::vector<std::string> troubles(const DeviceReport& report) {
    std::vector<std::string> out;
    for (const DeviceCheckResult& check : report.checks) {
        if (check.held() || !check.leftOut.empty()) continue;
        out.push_back(concat(check.kind, ": ", check.name, ": ",
                             check.failed.empty()
                                 ? formatted("%s, %.3g of what is tolerated", check.mismatch.worst.c_str(),
                                             check.mismatch.ofTolerance)
                                 : check.failed));
    }
    if (report.speeds)
        for (const BenchResult& result : report.speeds->results)
            if (!result.failed.empty()) out.push_back(concat(result.benchCase.name(), ": ", result.failed));
    for (const DrawnTimes& times : report.drawn)
        if (!times.failed.empty())
            out.push_back(
                concat("drawn: ", times.scene, ", ", times.width, " x ", times.height, ": ", times.failed));
    return out;
}

std::string asText(const DeviceReport& report, const std::string& file) {
    const auto count = [&](auto&& belongs) {
        return std::count_if(report.checks.begin(), report.checks.end(), belongs);
    };
    std::string out =
        concat(printable(file), ": ", count([](const DeviceCheckResult& check) { return check.held(); }),
               " of ", report.checks.size(), " checks held, ",
               count([](const DeviceCheckResult& check) { return !check.leftOut.empty(); }), " left out; ",
               report.speeds ? report.speeds->results.size() : 0, " cases, ", report.drawn.size(), " drawn; ",
               roughly(report.seconds), "\n");
    for (const std::string& trouble : troubles(report))
        out += concat("  ", trouble.substr(0, trouble.find('\n')), "\n");
    return out;
}

}  // namespace

int benchDeviceCommand(const Options& options) {
    checkWritable(options.report);
    const Files files;
    const StoredStates stored = readStoredStates(files.states);
    const Image sheet = readPng(files.pictures);
    const std::vector<NamedFile> scenes = shippedScenes();
    BenchSession session(options, secondsAGroup, quickSecondsAGroup);
    session.device.goesOn = true;
    session.mostSeconds.reset();  // a report has every group
    session.schedule.patience = patience;
    BenchDevice& device = session.device;
    DeviceReport report;
    report.date = today();
    const std::vector<DeviceCheck> checks = wantedChecks(options, scenes, stored, sheet, device);
    report.drawn = wantedPictures(options, scenes);
    const bool speeds = hasSpeeds(options);
    if (checks.empty() && report.drawn.empty() && !speeds)
        throw WrongUse(concat("--only: nothing has \"", options.only, "\" in its name"));
    {
        Progress progress("checks", int(checks.size()));
        for (const DeviceCheck& check : checks) {
            if (signalThatAsked()) return 1;
            report.checks.push_back(runCheck(check, session.context));
            progress.step();
        }
    }
    if (speeds) report.speeds = measureSpeeds(options, session);
    measureDrawn(options, scenes, device, report.drawn);
    if (signalThatAsked()) return 1;
    session.end();
    report.seconds = measure::secondsSince(session.start);
    writeFile(options.report, writeJson(asJson(report, session.machine, options.quick)));
    std::cout << asText(report, options.report);
    return 0;
}

}  // namespace shoal::app
