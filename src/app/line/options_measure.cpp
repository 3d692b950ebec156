#include "app/line/cli.h"
#include "app/line/commands.h"

#include <algorithm>

#include "measure/method_runner.h"
#include "scene/solver.h"

namespace shoal::app {

namespace {

// The benchmarks of `shoal bench` beside the simulation's frames.
const std::vector<std::string> benchWords = {"sort", "collide", "particles", "school"};
constexpr int (*benchCommands[])(const Options&) = {benchSortCommand, benchCollideCommand,
                                                    benchParticlesCommand, benchSchoolCommand};

// Turns the word behind `bench` into a command of its own.
void finishBench(Options& options) {
    if (options.command != benchCommand) return;
    if (!options.report.empty()) {
        if (!options.benchOf.empty())
            throw Error(
                concat("--report is of bench without a word: leave out \"", options.benchOf, "\", or it"));
        options.command = benchDeviceCommand;
    }
    if (options.benchOf.empty()) return;
    const std::string& word = options.benchOf;
    if (!options.only.empty() && word == "sort")
        throw Error("--only is not of bench sort, which measures everything: leave it out");
    options.command =
        benchCommands[std::find(benchWords.begin(), benchWords.end(), word) - benchWords.begin()];
}

}  // namespace

void addPath(CLI::App& command, Options& options) {
    section(command, execution);
    addRead(command, "--path",
            "fused: a kernel, in fragments where there are no compute shaders (OpenGL 4.3); ping-pong: "
            "passes",
            [&options](const std::string& word) { options.path = path(word); })
        ->type_name("fused|fragments|ping-pong|auto")
        ->default_str("auto");
    addRead(command, "--lanes", "Fused: a lane a molecule or a vertex",
            [&options](const std::string& word) { options.lanes = lanes(word); })
        ->type_name("molecule|vertex|auto")
        ->default_str("auto");
    command.add_flag("--in-place", options.inPlace, "Fused: one copy of the state instead of two");
}

void addContext(CLI::App& command, Options& options) {
    section(command, execution);
    addRead(command, "--context", "Where OpenGL comes from",
            [&options](const std::string& word) { options.context = gpu::contextKind(word); })
        ->type_name("window|egl|osmesa|auto")
        ->default_str("auto");
    addWhole(command, "--gpu", options.gpu, "EGL's device of this number, as shoal info lists them", 0);
    excludes(command, "--gpu", {"--context"});
    section(command, reports);
    command.add_flag("--json", options.json, "Report as JSON on standard output");
}

void addCountAndSeed(CLI::App& command, Options& options) {
    addWhole(command, "--count", options.count,
             "Molecules in each group that is placed at random; places where they are born", 1,
             maxGroupCount);
    command.add_option("--seed", options.seed, "Seed of all random numbers, instead of the scene's")
        ->check(
            isA<uint64_t>("a whole number from 0 to 18446744073709551615", [](uint64_t) { return true; }));
}

static void addSeconds(CLI::App& command, Options& options, const std::string& what) {
    addNumber(command, "--seconds", options.seconds, what, "a time above 0, at most 3600 s",
              [](double s) { return s > 0 && s <= 3600; });
}

void addBench(CLI::App& command, Options& options) {
    command
        .add_option("bench", options.benchOf,
                    "sort: the sorts; collide: contact; particles: points; school: fish; nothing: frames of "
                    "molecules")
        ->check(oneOf(benchWords))
        ->type_name(joined(benchWords, "|"));
    addContext(command, options);
    section(command, "What is measured");
    command.add_flag("--quick", options.quick,
                     "Small groups only, and of them what fits into half a minute; with --seconds all");
    addSeconds(command, options, "Time for each group of cases (default 12, quick 2)");
    command.add_option("--only", options.only, "Only cases with this in their name, such as \"fish\"");
    addFile(
        command, "--report", options.report,
        "Everything about this device into one JSON file, unattended: whether it computes and draws what it "
        "should, and how fast; about five minutes")
        ->group(reports);
    excludes(command, "--report", {"--json"});
}

void addMeasure(CLI::App& command, Options& options) {
    command.add_option("scene", options.files, "Scene file (.scene.json), or a name that shoal scenes lists")
        ->expected(1)
        ->type_name("SCENE");
    section(command, "What is measured");
    addError(command, options, "What the chosen method must reach (default 1e-3)");
    addReads(command, "--solvers", "Only these, such as euler,leapfrog", [&options](const std::string& word) {
        const std::optional<SolverKind> kind = solverOf(word);
        if (!kind) throw Error("expected the names of solvers; auto is the choice among them");
        options.solvers.push_back(*kind);
    })->delimiter(',');
    addReads(command, "--samplings", "Only these, such as vertexFrame", [&options](const std::string& word) {
        options.samplings.push_back(samplingOf(word));
    })->delimiter(',');
    addNumber(command, "--duration", options.duration, "Simulated seconds after which the error is taken",
              "a time above 0, at most 100 s", [](double s) { return s > 0 && s <= 100; })
        ->capture_default_str();
    addWhole(command, "--molecules", options.molecules,
             "Molecules of each group that the reference in double precision has (default 8; with "
             "--statistics as many as a minute allows, at most 64)",
             1, 1024);
    command.add_flag(
        "--statistics", options.statistics,
        "Means and quantiles over many seeds against a reference's, for scenes where paths part");
    addWhole(command, "--seeds", options.seeds, "With --statistics: runs, each by a seed of its own", 2,
             10000)
        ->capture_default_str();
    command.add_flag("--contact", options.contactCurve,
                     "Overlap, energy and momentum of contact between molecules, and its time, by substeps "
                     "and iterations");
    addWhole(command, "--substeps", options.eachSubsteps,
             "With --statistics or --contact: substeps of a frame, such as 4,16, instead of the scene's", 1,
             maxSubsteps)
        ->delimiter(',');
    addWhole(command, "--iterations", options.eachIterations,
             "With --contact: iterations of a contact step, instead of those around the scene's", 1,
             ContactSettings::mostIterations)
        ->delimiter(',');
    needs(command, "--seeds", "--statistics");
    needs(command, "--iterations", "--contact");
    addSeconds(command, options,
               "About how long all of it may take, beside compiling; leaves out what is dearest");
    section(command, reports);
    command.add_flag("--all", options.all, "Every point as text, not only the best ones");
    addFile(command, "--csv", options.csv, "Every point, or statistic, as a row of this file");
    excludes(command, "--statistics", {"--error", "--samplings", "--all"});
    excludes(command, "--contact",
             {"--statistics", "--error", "--solvers", "--samplings", "--molecules", "--all"});
    section(command, ofScene);
    addCountAndSeed(command, options);
    addPath(command, options);
    addContext(command, options);
}

FieldSampling samplingOf(const std::string& word) {
    std::vector<std::string> words;
    for (const FieldSampling sampling : measure::allSamplings) {
        if (word == name(sampling)) return sampling;
        words.emplace_back(name(sampling));
    }
    throw Error(concat("unknown sampling \"", word, "\"", suggestion(word, words)));
}

void finishMeasure(Options& options) {
    if (options.command == measureCommand && options.files.empty())
        throw Error("measure: expected a scene file");
    if (!options.eachSubsteps.empty() && !options.statistics && !options.contactCurve)
        throw Error("--substeps needs --statistics or --contact");
    finishBench(options);
}

}  // namespace shoal::app
