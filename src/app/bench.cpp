// `shoal bench`: speed against what the hardware allows, and the error that it buys.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "app/bench_report.h"
#include "app/commands.h"
#include "app/data_paths.h"
#include "app/progress.h"
#include "measure/pin_threads.h"
#include "render/renderer.h"

namespace shoal::app {

using namespace measure;

namespace {

constexpr int pictureWidth = 640, pictureHeight = 360;

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

Draw makeDraw(gpu::Context& context, const Scene& scene, const Plan& plan) {
    RenderOptions options;
    options.width = pictureWidth;
    options.height = pictureHeight;
    const auto renderer = std::make_shared<Renderer>(context, shaderRoot(), scene, plan, options);
    return [renderer, view = View::of(scene.camera)](const StateView& state) { renderer->draw(state, view); };
}

std::vector<BenchCase> wantedCases(const Options& options) {
    std::vector<BenchCase> out = benchCases(options.quick);
    const std::vector<BenchCase> all = out;
    std::erase_if(out,
                  [&](const BenchCase& one) { return one.name().find(options.only) == std::string::npos; });
    if (!out.empty()) return out;
    std::string names;
    for (const std::vector<BenchCase>& group : byGroup(all))
        names += (names.empty() ? "" : ", ") + group.front().group;
    throw Error(concat("--only: no case has \"", options.only, "\" in its name; there are ", names,
                       ", each with fused, ping-pong, AVX-512 and so on"));
}

// One bar for the whole run, whose end is estimated anew with every step.
class WholeRun {
  public:
    WholeRun(size_t groups, double secondsAGroup) : groups_(groups), secondsAGroup_(secondsAGroup) {}

    void say(size_t group, double left) {
        const double seconds = elapsed();
        const double rest = left + double(groups_ - group - 1) * secondsAGroup_;
        const int percent = std::min(99, int(100 * seconds / (seconds + rest)));
        for (; shown_ < percent; ++shown_)
            bar_.step();
    }
    void end() {
        for (; shown_ < 100; ++shown_)
            bar_.step();
    }
    double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    size_t groups_;
    double secondsAGroup_;
    int shown_ = 0;
    Progress bar_{"per cent", 100};
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string duration(double seconds) {
    if (seconds < 90) return concat(std::max(1, int(seconds + 0.5)), " s");
    return concat(int(seconds / 60 + 0.5), " minutes");
}

}  // namespace

int benchCommand(const Options& options) {
    const std::vector<std::vector<BenchCase>> groups = byGroup(wantedCases(options));
    const BenchMolecules molecules(moleculeFolder());
    gpu::ContextOptions wanted;
    wanted.kind = options.context;
    gpu::Context context(wanted);
    gpu::ProgramCache cache(context, gpu::ProgramCache::defaultFolder());

    BenchReport report;
    report.processor = processorName();
    report.cores = int(std::max(1u, std::thread::hardware_concurrency()));
    report.pinned = pinRasteriserThreads();
    report.context = context.info();
    report.quick = options.quick;
    report.secondsAGroup = options.seconds.value_or(options.quick ? 3 : 15);
    report.width = pictureWidth;
    report.height = pictureHeight;

    BenchDevice device;
    device.context = &context;
    device.shaderRoot = shaderRoot();
    device.cache = &cache;
    device.cores = report.cores;
    device.makeDraw = [&](const Scene& scene, const Plan& plan) { return makeDraw(context, scene, plan); };
    BenchSchedule schedule;
    schedule.seconds = report.secondsAGroup;

    // what a group takes beside its frames: compiling, placing, the least number of frames
    const double aGroup = report.secondsAGroup * 1.2 + 2;
    std::cerr << "This takes about " << duration(aGroup * double(groups.size())) << ".\n";
    WholeRun run(groups.size(), aGroup);
    for (size_t g = 0; g < groups.size(); ++g) {
        const auto progress = [&](const std::string&, double left) { run.say(g, left); };
        const std::vector<BenchResult> results =
            measureGroup(groups[g], molecules, device, schedule, progress);
        report.results.insert(report.results.end(), results.begin(), results.end());
    }
    run.end();
    report.seconds = run.elapsed();
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
