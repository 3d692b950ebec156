// `shoal measure`: what an error costs on a scene, for every method, step and field sampling.
#include <algorithm>
#include <iostream>
#include <thread>

#include "app/measure/measure.h"
#include "core/cache_folder.h"
#include "core/data_paths.h"
#include "core/file.h"
#include "core/printable.h"
#include "gpu/program_cache.h"
#include "run/progress.h"
#include "scene/json/scene_file.h"

namespace shoal::app {

using namespace measure;

namespace {

// Tells how long it will take, then shows how far it is.
class Bar {
  public:
    AccuracyProgress progress() {
        AccuracyProgress out;
        out.estimate = [this](double seconds) {
            std::cerr << "This takes about " << roughly(seconds) << ".\n";
            bar_ = std::make_unique<Progress>("per cent", 100);
        };
        out.left = [](double seconds, double share) {
            std::cerr << "Errors and times take about " << roughly(seconds) << " more";
            if (share < 1)
                std::cerr << ", for about " << std::max(1, int(100 * share))
                          << " % of all points: the dearest ones are left out";
            std::cerr << ".\n";
        };
        out.stage = [this](const char* words) {
            if (bar_) bar_->rename(concat(words, ", per cent"));
        };
        out.tell = [this](double share) {
            if (bar_) bar_->reach(int(100 * share));
        };
        return out;
    }
    void end() {
        if (bar_) bar_->reach(100);
    }

  private:
    std::unique_ptr<Progress> bar_;
};

AccuracyOptions accuracyOptions(const Options& options) {
    AccuracyOptions out{.duration = options.duration,
                        .solvers = options.solvers,
                        .samplings = options.samplings,
                        .seconds = options.seconds};
    out.molecules = options.molecules.value_or(out.molecules);
    out.enough = options.error.value_or(out.enough);
    return out;
}

void choose(const Scene& scene, const Options& options, const AccuracyDevice& device,
            std::optional<double> seconds, MeasureReport& report) {
    CalibrationOptions wanted = calibrationOptions(options);
    wanted.error = report.target;
    wanted.seconds = seconds;
    wanted.limitOption = "--seconds";
    wanted.solvers = options.solvers;
    wanted.samplings = options.samplings;
    if (seconds && *seconds <= 0) {
        report.notChosen = "no time is left to look for a method: give it more with --seconds";
        return;
    }
    try {
        report.chosen = calibrate(scene, wanted, device);
    } catch (const Error& error) {
        report.notChosen = error.message();
    }
}

void tell(const MeasureReport& report, const Options& options) {
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report, options.all));
    if (!options.csv.empty()) writeFile(options.csv, asCsv(report));
    if (!options.csv.empty() && !options.json) std::cout << "\ntable: " << printable(options.csv) << "\n";
}

}  // namespace

CalibrationOptions calibrationOptions(const Options& options) {
    CalibrationOptions out;
    if (options.error) out.error = *options.error;
    if (options.solver && *options.solver) out.solvers = {**options.solver};
    if (options.sampling) out.samplings = {*options.sampling};
    out.substeps = options.substeps;
    out.duration = options.duration;
    out.seconds = options.errorSeconds;
    out.version = SHOAL_VERSION;
    out.processor = bench::processorName();
    out.folder = cacheFolder();
    return out;
}

AccuracyDevice accuracyDevice(const Options& options, gpu::Context& context) {
    return {.context = &context,
            .cores = int(std::max(1u, std::thread::hardware_concurrency())),
            .path = options.path,
            .lanes = options.lanes,
            .inPlace = options.inPlace};
}

Calibration calibrated(const Options& options, gpu::Context& context, Loaded& loaded) {
    CalibrationOptions wanted = calibrationOptions(options);
    const Clock::time_point start = Clock::now();
    wanted.tell = [start](const std::string& what) {
        constexpr double silence = 2;  // s: what is quick says nothing
        if (secondsSince(start) > silence)
            std::cerr << "--error, after " << roughly(secondsSince(start)) << ": " << what << "\n";
    };
    Calibration out = calibrate(loaded.scene, wanted, accuracyDevice(options, context));
    measure::apply(out, loaded.scene);
    loaded.plan = compile(loaded.scene);
    tellWarnings(loaded.plan.warnings);
    return out;
}

MeasureReport measureScene(const Scene& scene, const Options& options, const AccuracyDevice& device) {
    MeasureReport report;
    report.machine = bench::measuredOn(*device.context, SHOAL_VERSION);
    report.target = options.error.value_or(1e-3);
    report.isTargetAsked = options.error.has_value();
    for (const Group& group : scene.groups)
        report.vertices += double(group.count) * double(group.molecule.vertices.size());
    AccuracyOptions wanted = accuracyOptions(options);
    wanted.extra = [&](std::optional<double> seconds) {
        choose(scene, options, device, seconds, report);
        std::vector<std::pair<Method, Step>> out;
        if (report.chosen) out.push_back({report.chosen->method, {report.chosen->substeps, 1}});
        return out;
    };
    Bar bar;
    report.accuracy = measureAccuracy(scene, wanted, device, bar.progress());
    bar.end();
    return report;
}

int measureCommand(const Options& options) {
    if (options.statistics) return statisticsCommand(options);
    if (options.contactCurve) return contactCommand(options);
    // known before the measuring, not after it
    if (!options.csv.empty()) checkWritable(options.csv);
    const Scene scene = readScene(options.files.front(), options);
    tellWarnings(scene.warnings);
    gpu::Context context(hiddenContext(options));
    const MeasureReport report = measureScene(scene, options, accuracyDevice(options, context));
    tellWarnings(context.cache().takeWarnings());
    tell(report, options);
    return 0;
}

}  // namespace shoal::app
