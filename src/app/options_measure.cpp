#include "app/cli.h"
#include "app/commands.h"

#include <algorithm>

#include "measure/method_runner.h"
#include "scene/solver.h"

namespace shoal::app {

namespace {

// The benchmarks of `shoal bench` beside the simulation's frames, each in a file bench_<word>.cpp.
const std::vector<std::string> benchWords = {"sort", "collide", "particles", "school"};
constexpr int (*benchCommands[])(const Options&) = {benchSortCommand, benchCollideCommand,
                                                    benchParticlesCommand, benchSchoolCommand};

void readLists(const Texts& texts, Options& options) {
    for (const std::string& word : texts.solvers) {
        const std::optional<SolverKind> kind = solverNamed("--solvers", word);
        if (!kind) throw Error("--solvers: expected the names of solvers; auto is the choice among them");
        options.solvers.push_back(*kind);
    }
    for (const std::string& word : texts.samplings)
        options.samplings.push_back(samplingNamed("--samplings", word));
}

void checkMeasure(const Options& options) {
    if (options.error && !(*options.error > 0 && *options.error <= 1))
        throw Error(concat("--error: expected a relative error above 0, at most 1, found ", *options.error));
    if (options.command != measureCommand) return;
    if (options.files.empty() == options.report.empty())
        throw Error("measure: expected a scene file, or --report and a folder");
    if (!(options.duration > 0 && options.duration <= 100))
        throw Error(concat("--duration: expected a time above 0, at most 100 s, found ", options.duration));
    if (options.molecules < 1 || options.molecules > 1024)
        throw Error(concat("--molecules: expected 1 to 1024, found ", options.molecules));
}

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
    const auto found = std::find(benchWords.begin(), benchWords.end(), word);
    const std::string near = nearest(word, benchWords);
    if (found == benchWords.end())
        throw Error(concat("bench: unknown \"", word, "\"",
                           near.empty() ? "" : " (did you mean \"" + near + "\"?)", "; expected ",
                           joined(benchWords, ", "), " or nothing"));
    if (!options.plot.empty())
        throw Error(concat("--plot is of bench without a word: leave out \"", word, "\", or it"));
    if (!options.only.empty() && word == "sort")
        throw Error("--only is not of bench sort, which measures everything: leave it out");
    options.command = benchCommands[found - benchWords.begin()];
}

}  // namespace

void addPath(CLI::App& command, Options& options, Texts& texts) {
    section(command, execution);
    command
        .add_option(
            "--path", texts.path,
            "fused: a kernel, in fragments where there are no compute shaders (OpenGL 4.3); ping-pong: "
            "passes")
        ->type_name("fused|fragments|ping-pong|auto")
        ->capture_default_str();
    command.add_option("--lanes", texts.lanes, "Fused: a lane a molecule or a vertex")
        ->type_name("molecule|vertex|auto")
        ->capture_default_str();
    command.add_flag("--in-place", options.inPlace, "Fused: one copy of the state instead of two");
}

void addContext(CLI::App& command, Options& options, Texts& texts) {
    section(command, execution);
    command.add_option("--context", texts.context, "Where OpenGL comes from")
        ->type_name("window|egl|osmesa|auto")
        ->capture_default_str();
    addWhole(command, "--gpu", options.gpu, "EGL's device of this number, as shoal info lists them");
    excludes(command, "--gpu", {"--context"});
    section(command, reports);
    command.add_flag("--json", options.json, "Report as JSON on standard output");
}

void addCountAndSeed(CLI::App& command, Options& options) {
    addWhole(command, "--count", options.count,
             "Molecules in each group that is placed at random; places where they are born");
    command.add_option("--seed", options.seed, "Seed of all random numbers, instead of the scene's")
        ->check(kindOf(isAll<uint64_t>, "a whole number from 0 to 18446744073709551615"));
}

void addBench(CLI::App& command, Options& options, Texts& texts) {
    command
        .add_option("of", options.benchOf,
                    "sort: the sorts; collide: contact; particles: points; school: fish; nothing: frames of "
                    "molecules")
        ->type_name(joined(benchWords, "|"));
    addContext(command, options, texts);
    section(command, "What is measured");
    command.add_flag("--quick", options.quick, "Small groups only, and less time: about half a minute");
    addNumber(command, "--seconds", options.seconds, "Time for each group of cases (default 12, quick 2)",
              "a time in seconds");
    command.add_option("--only", options.only, "Only cases with this in their name, such as \"fish\"");
    addFile(command, "--plot", options.plot, "Time per molecule against their number (.svg or .png)")
        ->group(reports);
    addFile(
        command, "--report", options.report,
        "Everything about this device into one JSON file, unattended: whether it computes and draws what it "
        "should, and how fast; about five minutes")
        ->group(reports);
    excludes(command, "--report", {"--json", "--plot"});
}

void addMeasure(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("scene", options.files, "Scene file (.scene.json), or a name that shoal scenes lists")
        ->expected(1)
        ->type_name("SCENE");
    section(command, "What is measured");
    addNumber(command, "--error", options.error, "What the chosen method must reach (default 1e-3)",
              "an error such as 1e-3");
    command.add_option("--solvers", texts.solvers, "Only these, such as euler,leapfrog")->delimiter(',');
    command.add_option("--samplings", texts.samplings, "Only these, such as vertexFrame")->delimiter(',');
    addNumber(command, "--duration", options.duration, "Simulated seconds after which the error is taken",
              "a time in seconds")
        ->capture_default_str();
    addWhole(command, "--molecules", options.molecules, "Molecules of each group whose error is measured")
        ->capture_default_str();
    addNumber(command, "--seconds", options.seconds, "About how long to measure; leaves out what is dearest",
              "a time in seconds");
    command.add_flag("--fine", options.fine, "Steps by the square root of 2 instead of 2");
    section(command, reports);
    addFile(command, "--csv", options.csv, "Every point as a row of this file");
    addFile(command, "--plot", options.plot, "Error against time (.svg or .png)");
    command
        .add_option("--report", options.report,
                    "Measures the report's own scenes into this folder, and goes on where it was ended")
        ->type_name("FOLDER");
    command.add_option("--only", options.only,
                       "With --report: scenes with this in their name, such as leaf-fall");
    section(command, ofScene);
    addCountAndSeed(command, options);
    addPath(command, options, texts);
    addContext(command, options, texts);
    // The report writes files of its own, and its scenes have their own times and seeds.
    excludes(command, "--report", {"--json", "--csv", "--plot", "--duration", "--seed"});
    needs(command, "--only", "--report");
}

std::optional<SolverKind> solverNamed(const char* option, const std::string& word) {
    try {
        return solverOf(word);
    } catch (const Error& error) {
        throw Error(concat(option, ": ", error.message()));
    }
}

FieldSampling samplingNamed(const char* option, const std::string& word) {
    std::vector<std::string> words;
    for (const FieldSampling one : measure::allSamplings) {
        if (word == name(one)) return one;
        words.emplace_back(name(one));
    }
    throw Error(concat(option, ": unknown sampling \"", word, "\"", suggestion(word, words)));
}

void finishMeasure(const Texts& texts, Options& options) {
    readLists(texts, options);
    checkMeasure(options);
    finishBench(options);
}

}  // namespace shoal::app
