// `shoal measure --report`: the report's own scenes, one JSON each, then pictures and tables of all:
//
//   <folder>/<molecule>-<motion>-<stiffness>.json    what `shoal measure --json` says
//   <folder>/<molecule>.png                          a row a motion, a column a stiffness
//   <folder>/tables.md                               speed-ups, costs, what is chosen
//
// A scene whose file is there is not measured again, so that a run goes on where it was ended; unless it was
// measured with something else than this run would (MeasuredWith in app/measure.h).
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/measure.h"
#include "app/plot.h"
#include "core/file.h"
#include "core/printable.h"
#include "run/progress.h"

namespace shoal::app {

using namespace measure;
namespace fs = std::filesystem;

namespace {

// Enough to fill the device.
constexpr int moleculesOnGpu = 16384, moleculesOnCpu = 4096;
constexpr double usualSeconds = 60;  // of a scene, before one has been measured

std::string fileOf(const Options& options, const ReportScene& scene) {
    return (fs::path(options.report) / (scene.id + ".json")).string();
}

AccuracyPanel panelOf(const ReportScene& scene, const ReportEntry& entry) {
    AccuracyPanel out;
    out.title = concat(scene.motion, ", k = 1e", std::lround(std::log10(scene.stiffness)),
                       !entry.accuracy.chaotic.empty()    ? ": chaotic, no error"
                       : !entry.accuracy.tooStiff.empty() ? ": too stiff, no error"
                                                          : "");
    out.points = entry.accuracy.points;
    for (const AccuracyPoint& point : out.points)
        if (entry.chosen && point.method == entry.chosen->method &&
            point.step == Step{entry.chosen->substeps, 1})
            out.chosen = point;
    out.target = entry.chosen ? entry.chosen->target : 0;
    return out;
}

void tellLeft(size_t index, size_t count, const ReportScene& scene, double secondsEach) {
    std::cerr << "scene " << index + 1 << " of " << count << ", " << scene.scene.name
              << "; all that is left takes about " << roughly(secondsEach * double(count - index)) << "\n";
}

// Returns how this run would measure the scene, as its report would say.
MeasuredWith withWhat(const Options& options, const ReportScene& scene, const AccuracyDevice& device) {
    const gpu::ContextInfo& info = device.context->info();
    MeasuredWith out;
    out.processor = processorName();
    out.cores = device.cores;
    out.renderer = info.renderer;
    out.context = gpu::name(info.kind);
    out.opengl = info.version;
    if (options.path != Path::automatic) out.path = name(options.path);
    out.scene = scene.scene.name;
    out.frameRate = scene.scene.frameRate;
    out.duration = std::max(1.0, std::round(scene.duration * out.frameRate)) / out.frameRate;
    out.target = options.error.value_or(out.target);
    for (const Group& group : scene.scene.groups) {
        out.molecules.emplace_back(std::min(group.count, options.molecules),
                                   std::min(group.count, AccuracyOptions().timedMolecules));
        out.shapes.emplace_back(group.molecule.vertices.size(), group.molecule.springs.size());
    }
    for (const Solver& solver : solvers())
        if (options.solvers.empty() ||
            std::count(options.solvers.begin(), options.solvers.end(), solver.kind))
            out.solvers.insert(solver.name);
    for (const FieldSampling sampling : options.samplings)
        out.samplings.insert(name(sampling));
    return out;
}

bool isMissing(const Options& options, const ReportScene& scene, const AccuracyDevice& device) {
    const std::optional<Measured> found = readMeasured(fileOf(options, scene));
    if (!found) return true;
    const std::string differs = difference(found->conditions, withWhat(options, scene, device));
    if (!differs.empty()) std::cerr << scene.id << ": measured again, because " << differs << " differs\n";
    return !differs.empty();
}

// Measures the scenes that are asked for and have no file yet, or one that was measured differently.
void measureMissing(const Options& options, const std::vector<ReportScene>& all,
                    const AccuracyDevice& device) {
    std::vector<const ReportScene*> missing;
    for (const ReportScene& scene : all)
        if (scene.id.find(options.only) != std::string::npos && isMissing(options, scene, device))
            missing.push_back(&scene);
    const Clock::time_point start = Clock::now();
    for (size_t i = 0; i < missing.size(); ++i) {
        const double passed = secondsSince(start);
        tellLeft(i, missing.size(), *missing[i],
                 i > 0 ? passed / double(i) : options.seconds.value_or(usualSeconds));
        Options own = options;
        own.duration = missing[i]->duration;
        writeFile(fileOf(options, *missing[i]),
                  writeJson(asJson(measureScene(missing[i]->scene, own, device))));
    }
}

// Returns the heads of all files, each once: with --only, some may have been measured elsewhere.
std::string headOf(const std::vector<std::optional<Measured>>& found) {
    std::vector<std::string> heads;
    for (const std::optional<Measured>& result : found) {
        if (!result) continue;
        const MeasuredWith& conditions = result->conditions;
        const auto [measured, timed] = conditions.molecules.at(0);
        const std::string head = concat(
            "Machine: ", printable(conditions.processor), ". Context: ", printable(conditions.renderer), " (",
            printable(conditions.context), "), OpenGL ", printable(conditions.opengl), ". ", timed,
            " molecules timed, ", measured, " measured.\n\n");
        if (std::find(heads.begin(), heads.end(), head) == heads.end()) heads.push_back(head);
    }
    std::string out;
    for (const std::string& head : heads)
        out += head;
    return out;
}

std::string tables(const std::vector<ReportEntry>& entries, double error) {
    return concat("## Cheapest method for an error of ", error, ", and how many times as fast as euler\n\n",
                  speedUpTable(entries, error),
                  "\n## Nanoseconds per vertex and simulated second for an error of ", error, "\n\n",
                  costTable(entries, error), "\n## What the calibration chooses, with its substeps\n\n",
                  chosenTable(entries));
}

// The scenes that have been measured, with the places of the others left empty.
void drawAll(const Options& options, const std::vector<ReportScene>& all,
             const std::vector<std::optional<Measured>>& found, const std::string& machine) {
    for (const std::string molecule : reportMolecules) {
        std::vector<AccuracyPanel> panels;
        bool any = false;
        for (size_t i = 0; i < all.size(); ++i) {
            if (all[i].molecule != molecule) continue;
            panels.push_back(found[i] ? panelOf(all[i], found[i]->entry) : AccuracyPanel{});
            any |= plottable(panels.back().points);
        }
        if (any)
            plotGrid((fs::path(options.report) / (molecule + ".png")).string(),
                     concat(molecule, "; ", machine), int(std::size(reportStiffnesses)), panels);
    }
}

std::vector<std::optional<Measured>> readAll(const Options& options, const std::vector<ReportScene>& all) {
    std::vector<std::optional<Measured>> out;
    for (const ReportScene& scene : all) {
        std::optional<Measured>& result = out.emplace_back(readMeasured(fileOf(options, scene)));
        if (!result) continue;
        result->entry.molecule = scene.molecule;
        result->entry.motion = scene.motion;
        result->entry.stiffness = scene.stiffness;
    }
    return out;
}

// The pictures and tables of what is there.
void tellAll(const Options& options, const std::vector<ReportScene>& all) {
    const std::vector<std::optional<Measured>> found = readAll(options, all);
    std::vector<ReportEntry> entries;
    std::string machine;  // of the first
    for (const std::optional<Measured>& result : found) {
        if (!result) continue;
        if (entries.empty()) machine = result->conditions.processor + ", " + result->conditions.renderer;
        entries.push_back(result->entry);
    }
    if (entries.empty())
        throw WrongUse(concat("--only: no scene of the report has \"", options.only, "\" in its name"));
    const std::string text = headOf(found) + tables(entries, options.error.value_or(1e-3));
    writeFile(fs::path(options.report) / "tables.md", text);
    drawAll(options, all, found, machine);
    std::cout << text;
    std::cerr << "tables and pictures: " << printable(options.report) << "\n";
}

}  // namespace

// In frames that long, fields have to be read in every substep.
int measureReport(const Options& given) {
    Options options = given;
    if (options.samplings.empty()) options.samplings = {FieldSampling::vertexSubstep};
    needGnuplot((fs::path(options.report) / "tables.md").string());
    gpu::Context context(hiddenContext(options));
    const int count = options.count.value_or(context.info().software ? moleculesOnCpu : moleculesOnGpu);
    const std::vector<ReportScene> all = reportScenes(count);
    measureMissing(options, all, accuracyDevice(options, context));
    tellAll(options, all);
    return 0;
}

}  // namespace shoal::app
