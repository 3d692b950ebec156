// `shoal bench`: speed against what the hardware allows, and the error that it buys.
#include <algorithm>
#include <iostream>
#include <memory>
#include <numeric>

#include "app/bench.h"
#include "app/bullet_baseline.h"
#include "app/commands.h"
#include "app/plot.h"
#include "core/cache_folder.h"
#include "core/printable.h"
#include "measure/timing.h"
#include "render/renderer.h"
#include "run/data_paths.h"
#include "run/progress.h"

namespace shoal::app {

using namespace bench;

namespace {

using measure::Clock, measure::secondsSince;

constexpr int pictureWidth = 640, pictureHeight = 360;

class BulletRunner : public BenchRunner {
  public:
    BulletRunner(const BenchCase& one, const Molecule& molecule) : one_(one), molecule_(molecule) {
        restart();
    }
    void restart() override {
        bullet_ = std::make_unique<BulletBaseline>(molecule_, one_.count,
                                                   one_.subject == Subject::bulletMerged
                                                       ? BulletBaseline::Form::merged
                                                       : BulletBaseline::Form::bodies);
    }
    void frame() override {
        for (int i = 0; i < one_.substeps; ++i)
            bullet_->frame(1.0 / 60 / one_.substeps);
    }

  private:
    BenchCase one_;
    const Molecule& molecule_;
    std::unique_ptr<BulletBaseline> bullet_;
};

// Everything is asked for by its name: cases, and these beside them.
constexpr const char *errors = "errors", *starts = "start-up", *passes = "passes";

// The cases and measurements that this run was asked for.
struct Wanted {
    std::vector<std::vector<BenchCase>> groups;
    bool errors = false, starts = false, passes = false;
};

Wanted wantedOf(const Options& options) {
    const auto named = [&](const std::string& name) { return name.find(options.only) != std::string::npos; };
    const std::vector<BenchCase> all = benchCases(options.quick);
    std::vector<BenchCase> some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some),
                 [&](const BenchCase& one) { return named(one.name()); });
    Wanted out{byGroup(some), named(errors), named(starts), named(passes)};
    if (!some.empty() || out.errors || out.starts || out.passes) {
        if (!options.plot.empty()) checkPlot(options.plot, some);
        return out;
    }
    std::string names;
    for (const std::vector<BenchCase>& group : byGroup(all))
        names += "\"" + group.front().group + "\", ";
    throw Error(concat("--only: nothing has \"", options.only, "\" in its name; there are ", names,
                       "each with fused, ping-pong, AVX-512 and so on, and \"", errors, "\", \"", starts,
                       "\", \"", passes, "\""));
}

// One bar for the whole run, whose end is estimated anew with every step.
class WholeRun {
  public:
    // `parts`: seconds that each is expected to take.
    explicit WholeRun(std::vector<double> parts) : parts_(std::move(parts)) {}

    double expected() const { return std::accumulate(parts_.begin(), parts_.end(), 0.0); }
    // `left`: seconds until this part ends.
    void tell(double left) {
        const double rest = std::accumulate(parts_.begin() + part_ + 1, parts_.end(), left);
        show(std::min(99, int(100 * elapsed() / (elapsed() + rest))));
    }
    void tellShare(double share) { tell((1 - share) * parts_[size_t(part_)]); }
    void next() { ++part_; }
    void end() { show(100); }
    double elapsed() const { return secondsSince(start_); }

  private:
    void show(int percent) {
        for (; shown_ < percent; ++shown_)
            bar_.step();
    }

    std::vector<double> parts_;
    ptrdiff_t part_ = 0;
    int shown_ = 0;
    Progress bar_{"per cent", 100};
    Clock::time_point start_ = Clock::now();
};

BenchReport describe(const Options& options, const gpu::Context& context) {
    BenchReport out;
    out.machine = measuredOn(context);
    out.machine.pinned = measure::pinRasteriserThreads();
    out.quick = options.quick;
    out.whole = options.only.empty();
    out.secondsAGroup = options.seconds.value_or(options.quick ? 2 : 12);
    out.width = pictureWidth;
    out.height = pictureHeight;
    return out;
}

// Expected seconds of each part, in the order of measureAll.
std::vector<double> expectedSeconds(const Wanted& wanted, const BenchReport& report) {
    std::vector<double> out;
    for (const std::vector<BenchCase>& group : wanted.groups) {
        // the smallest have all their samples before the time is up; of the largest, pictures above all, the
        // least number takes longer
        const int count = group.front().count;
        const double share = count < 2000 && group.front().molecule == "quad" ? 0.4
                             : count > 1000000                                ? 2.2
                                                                              : 1.1;
        out.push_back(share * report.secondsAGroup + 1);
    }
    if (wanted.passes) out.push_back(report.secondsAGroup + 1);
    if (wanted.errors) out.push_back(report.quick ? 2 : 8);
    if (wanted.starts) out.push_back(report.quick ? 2 : 8);
    return out;
}

void measureAll(const Wanted& wanted, const BenchMolecules& molecules, const BenchDevice& device,
                BenchReport& report) {
    WholeRun run(expectedSeconds(wanted, report));
    std::cerr << "This takes about " << roughly(run.expected()) << ".\n";
    const auto share = [&](double done) { run.tellShare(done); };
    measure::Schedule schedule;
    schedule.seconds = report.secondsAGroup;
    for (const std::vector<BenchCase>& group : wanted.groups) {
        const auto progress = [&](const std::string&, double left) { run.tell(left); };
        const std::vector<BenchResult> results = measureGroup(group, molecules, device, schedule, progress);
        report.results.insert(report.results.end(), results.begin(), results.end());
        run.next();
    }
    if (wanted.passes) {
        report.passes = measurePasses(molecules, device, report.quick, report.secondsAGroup, share);
        run.next();
    }
    if (wanted.errors) {
        report.errors = measureErrors(molecules, device, report.quick ? 16 : 64, share);
        run.next();
    }
    if (wanted.starts) report.starts = measureStart(molecules, device, report.quick, share);
    run.end();
    report.seconds = run.elapsed();
}

}  // namespace

DrawMaker drawMaker(gpu::Context& context) {
    return [&context](const Scene& scene, const Plan& plan) -> Draw {
        RenderOptions options;
        options.width = pictureWidth;
        options.height = pictureHeight;
        const auto renderer = std::make_shared<Renderer>(context, shaderRoot(), scene, plan, options);
        return [renderer, view = View::of(scene.camera)](const StateView& state) {
            renderer->draw(state, view);
        };
    };
}

int benchCommand(const Options& options) {
    if (options.benchOf == "sort") return benchSortCommand(options);
    if (options.benchOf == "collide") return benchCollideCommand(options);
    if (options.benchOf == "particles") return benchParticlesCommand(options);
    if (options.benchOf == "school") return benchSchoolCommand(options);
    const Wanted wanted = wantedOf(options);
    const BenchMolecules molecules(moleculeFolder());
    const Clock::time_point start = Clock::now();
    gpu::Context context(hiddenContext(options));
    const double contextSeconds = secondsSince(start);
    BenchReport report = describe(options, context);
    report.contextSeconds = contextSeconds;
    if (!context.info().computeShaders)
        std::cerr << "shoal: warning: the fused path needs OpenGL 4.3, and this context has "
                  << context.info().version << ": its cases are left out\n";

    gpu::ProgramCache cache(context, cacheFolder());
    BenchDevice device{&context, shaderRoot(), &cache, drawMaker(context), report.machine.cores, {}};
    if (bulletAvailable())
        device.makeBullet = [](const BenchCase& one, const Molecule& molecule) {
            return std::make_unique<BulletRunner>(one, molecule);
        };
    measureAll(wanted, molecules, device, report);
    tellWarnings(cache.takeWarnings());
    if (!options.plot.empty())
        plotBench(options.plot, report.machine.processor + ", " + context.info().renderer, report.results);
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    if (!options.plot.empty() && !options.json) std::cout << "\nplot: " << printable(options.plot) << "\n";
    return 0;
}

}  // namespace shoal::app
