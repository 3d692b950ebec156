// `shoal bench`: speed against what the hardware allows, and the error that it buys.
#include <algorithm>
#include <iostream>
#include <memory>
#include <numeric>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "core/data_paths.h"
#include "core/printable.h"
#include "gpu/program_cache.h"
#include "measure/timing.h"
#include "render/renderer.h"
#include "run/progress.h"

namespace shoal::app {

using namespace bench;

namespace {

constexpr double quickSeconds = 30;  // that --quick may take, as its help says

// Everything is asked for by its name: cases, and these beside them.
constexpr const char *errors = "errors", *starts = "start-up", *passes = "passes";

// The cases and measurements that this run was asked for.
struct Wanted {
    std::vector<std::vector<BenchCase>> groups;
    bool errors = false, starts = false, passes = false;
};

// Error: there is none, unless there may be none.
Wanted wantedOf(const Options& options, bool some = true) {
    const auto named = [&](const std::string& name) { return name.find(options.only) != std::string::npos; };
    const std::vector<BenchCase> all = benchCases(options.quick);
    std::vector<BenchCase> chosen;
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen),
                 [&](const BenchCase& benchCase) { return named(benchCase.name()); });
    Wanted out{byGroup(chosen), named(errors), named(starts), named(passes)};
    if (!some || !chosen.empty() || out.errors || out.starts || out.passes) return out;
    std::string names;
    for (const std::vector<BenchCase>& group : byGroup(all))
        names += "\"" + group.front().group + "\", ";
    throw Error(concat("--only: nothing has \"", options.only, "\" in its name; there are ", names,
                       "each with fused, ping-pong, AVX-512 and so on, and \"", errors, "\", \"", starts,
                       "\", \"", passes, "\""));
}

struct BenchPart {
    std::string name;
    double expected;  // s
    std::function<void(const BenchProgress&)> measure;
};

double expectedSeconds(const BenchCase& first, double secondsAGroup) {
    // the smallest have all their samples before the time is up; of the largest, pictures above all, the
    // least number takes longer
    const double share = first.count < 2000 && first.molecule == "quad" ? 0.4
                         : first.count > 1000000                        ? 2.2
                                                                        : 1.1;
    return share * secondsAGroup + 1;
}

std::vector<BenchPart> partsOf(const Wanted& wanted, const BenchMolecules& molecules,
                               const BenchDevice& device, const measure::Schedule& schedule,
                               BenchReport& report) {
    std::vector<BenchPart> out;
    for (const std::vector<BenchCase>& group : wanted.groups)
        out.push_back({group.front().group, expectedSeconds(group.front(), report.secondsAGroup),
                       [&](const BenchProgress& progress) {
                           const std::vector<BenchResult> results =
                               measureGroup(group, molecules, device, schedule, progress);
                           report.results.insert(report.results.end(), results.begin(), results.end());
                       }});
    const double fewSeconds = report.quick ? 2 : 8;
    if (wanted.passes)
        out.push_back({passes, report.secondsAGroup + 1, [&](const BenchProgress& progress) {
                           report.passes =
                               measurePasses(molecules, device, report.quick, report.secondsAGroup, progress);
                       }});
    if (wanted.errors)
        out.push_back({errors, fewSeconds, [&](const BenchProgress& progress) {
                           report.errors = measureErrors(molecules, device, report.quick ? 16 : 64, progress);
                       }});
    if (wanted.starts)
        out.push_back({starts, fewSeconds, [&](const BenchProgress& progress) {
                           report.starts = measureStart(molecules, device, report.quick, progress);
                       }});
    return out;
}

// Runs a part. Where the device goes on after failures, that of a whole part is one of the report's.
void runPart(const BenchPart& part, const BenchDevice& device, BenchReport& report,
             const BenchProgress& progress) {
    try {
        part.measure(progress);
        device.context->checkAlive();
    } catch (const gpu::DeviceLost&) {
        throw;
    } catch (const Error& error) {
        if (!device.goesOn) throw;
        BenchResult failed;
        failed.benchCase.group = part.name;
        failed.benchCase.label = "all of it";
        failed.failed = error.what();
        report.results.push_back(std::move(failed));
    }
}

void measureAll(const Wanted& wanted, const BenchMolecules& molecules, const BenchDevice& device,
                const BenchSession& session, BenchReport& report) {
    const std::vector<BenchPart> parts = partsOf(wanted, molecules, device, session.schedule, report);
    std::vector<double> expected;
    for (const BenchPart& part : parts)
        expected.push_back(part.expected);
    WholeRun run(expected, session.mostSeconds);
    const BenchProgress progress = [&](double share) { run.tell(share); };
    for (const BenchPart& part : parts) {
        if (!run.fits()) {
            report.leftOut.push_back(part.name);
            run.leaveOut();
            continue;
        }
        runPart(part, device, report, progress);
        run.next();
    }
    run.end();
    report.seconds = run.elapsed();
}

}  // namespace

static DrawMaker drawMaker(gpu::Context& context) {
    return [&context](const Scene& scene, const Plan& plan) -> Draw {
        RenderOptions options;
        options.width = pictureWidth;
        options.height = pictureHeight;
        const auto renderer = std::make_shared<Renderer>(context, scene, plan, options);
        return [renderer, view = View::fromCamera(scene.camera)](const StateView& state) {
            renderer->draw(state, view);
        };
    };
}

BenchSession::BenchSession(const Options& options, double usual, double quick)
    : context(hiddenContext(options)),
      contextSeconds(measure::secondsSince(start)),
      machine(bench::measuredOn(context, SHOAL_VERSION)),
      device{&context, drawMaker(context), machine.cores, false, !context.info().software} {
    schedule.seconds = options.seconds.value_or(options.quick ? quick : usual);
    if (options.quick && !options.seconds) mostSeconds = quickSeconds;
}

void BenchSession::end() {
    machine.pinned = measure::pinRasteriserThreads();
    tellWarnings(context.cache().takeWarnings());
}

WholeRun::WholeRun(std::vector<double> parts, std::optional<double> most)
    : parts_(std::move(parts)), most_(most) {
    std::cerr << "This takes about " << roughly(std::accumulate(parts_.begin(), parts_.end(), 0.0)) << ".\n";
    bar_.emplace("per cent", 100);
}

void WholeRun::tell(double share) {
    const double rest =
        std::accumulate(parts_.begin() + part_ + 1, parts_.end(), (1 - share) * parts_[size_t(part_)]);
    bar_->reach(std::min(99, int(100 * elapsed() / (elapsed() + rest))));
}

bool WholeRun::fits() const {
    return !most_ || fitsAtPace(parts_[size_t(part_)], expected_, elapsed(), *most_);
}

void WholeRun::next() {
    expected_ += parts_[size_t(part_)];
    ++part_;
}

BenchReport measureSpeeds(const Options& options, BenchSession& session) {
    const Wanted wanted = wantedOf(options);
    const BenchMolecules molecules(moleculeFolder());
    const gpu::ContextInfo& info = session.context.info();
    BenchReport report;
    report.machine = session.machine;
    report.machine.pinned = measure::pinRasteriserThreads();
    report.quick = options.quick;
    report.whole = options.only.empty();
    report.secondsAGroup = session.schedule.seconds;
    report.contextSeconds = session.contextSeconds;
    if (!info.computeShaders)
        std::cerr << "shoal: warning: the fused path needs OpenGL 4.3, and this context has " << info.version
                  << ": its cases are left out\n";
    measureAll(wanted, molecules, session.device, session, report);
    return report;
}

bool hasSpeeds(const Options& options) {
    const Wanted wanted = wantedOf(options, false);
    return !wanted.groups.empty() || wanted.errors || wanted.starts || wanted.passes;
}

int benchCommand(const Options& options) {
    wantedOf(options);  // before anything is made
    BenchSession session(options, 12, 2);
    const BenchReport report = measureSpeeds(options, session);
    session.end();
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
