#include "app/options.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/cli.h"
#include "app/interface.h"
#include "core/file.h"
#include "scene/scene_file.h"

namespace shoal::app {

namespace {

struct Texts {
    std::string context = "auto", size = "1280x720", path = "auto", lanes = "auto", solver, slice,
                exportCells = "surface";
    std::vector<std::string> solvers, samplings;
};

void addSandbox(CLI::App& command, Options& options) {
    command.add_flag("--sandbox", options.sandbox,
                     "Open nothing outside the file's own folder and the shipped data, links followed");
}

void addScene(CLI::App& command, Options& options) {
    command.add_option("scene", options.files, "Scene file (.scene.json)")->required()->expected(1);
}

CLI::Validator wholeNumber() {
    return kindOf(isAll<int>, "a whole number");
}

void addOverrides(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("--dt", options.dt, "Seconds that one frame simulates, instead of the scene's")
        ->check(kindOf(isAll<double>, "a time in seconds"));
    command.add_option(
        "--solver", texts.solver,
        "auto, euler, verlet, leapfrog, rk4, xpbd, bdf2-xpbd or bdf2-corotated, instead of the scene's");
    command.add_option("--substeps", options.substeps, "Substeps of a frame, instead of the scene's")
        ->check(wholeNumber());
    command.add_option("--field-sampling", options.fieldSampling,
                       "vertexSubstep, vertexFrame or moleculeFrame, instead of the scene's");
    command
        .add_option("--count", options.count,
                    "Molecules in each group that is placed at random; places where they are born")
        ->check(wholeNumber());
    command.add_option("--seed", options.seed, "Seed of all random numbers, instead of the scene's")
        ->check(kindOf(isAll<uint64_t>, "a whole number from 0 to 18446744073709551615"));
}

void addPath(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("--path", texts.path, "fused (OpenGL 4.3), ping-pong (3.3) or auto")
        ->capture_default_str();
    command
        .add_option("--lanes", texts.lanes, "Fused: a lane a molecule or a vertex: molecule, vertex or auto")
        ->capture_default_str();
    command.add_flag("--in-place", options.inPlace, "Fused: one copy of the state instead of two");
}

void addContext(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("--context", texts.context, "window, egl, osmesa or auto")->capture_default_str();
    command.add_flag("--json", options.json, "Report as JSON on standard output");
}

void addError(CLI::App& command, Options& options) {
    command
        .add_option("--error", options.error,
                    "Cheapest solver, substeps and field sampling whose measured error is below this")
        ->check(kindOf(isAll<double>, "an error such as 1e-3"));
}

void addEdit(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("molecule", options.files, "Molecule file")->required()->expected(1);
    command.add_option("--size", texts.size, "Size of the window in pixels")->capture_default_str();
    command
        .add_option("--scale", options.scale, "Pixels a point of the panels; as the screen asks unless given")
        ->check(kindOf(isAll<double>, "a number"));
    command.add_option("--frames", options.frames, "Close after so many frames")->check(wholeNumber());
    command.add_option("--screenshot", options.screenshot, "With --frames: a picture of the last, as PNG");
}

void addRun(CLI::App& command, Options& options, Texts& texts) {
    command
        .add_option("scene", options.files,
                    "Scene file (.scene.json); nothing, or a folder: a window lists those to choose from")
        ->expected(0, 1);
    addError(command, options);
    addOverrides(command, options, texts);
    addPath(command, options, texts);
    addContext(command, options, texts);
    command.add_flag("--headless", options.headless, "No window, even where there is a display");
    command.add_option("--frames", options.frames, "Stop after so many frames (headless: 240)")
        ->check(wholeNumber());
    command.add_option("--size", texts.size, "Picture size in pixels")->capture_default_str();
    command
        .add_option("--scale", options.scale,
                    "Window: size of panels and letters, such as 2 (default: as the screen asks)")
        ->check(kindOf(isAll<double>, "a factor such as 1.5"));
    command.add_option("--capture", options.capture,
                       "Folder for PNG frames, or a video (.mp4, .mkv, .webm, .mov)");
    command.add_option("--capture-every", options.captureEvery, "Take every n-th frame")
        ->check(wholeNumber())
        ->capture_default_str();
    command.add_option(
        "--export", options.exports,
        "State: folder (CSV), or a name ending in .csv, .ply, .vtp, or .pvd (an index and .vtp files)");
    command.add_option("--export-frames", options.exportFrames, "Frames to export (default: the last)")
        ->delimiter(',')
        ->check(wholeNumber());
    command.add_option("--export-every", options.exportEvery, "Export every n-th frame (.pvd: default 1)")
        ->check(wholeNumber());
    command.add_option("--export-cells", texts.exportCells,
                       ".vtp, .pvd: surface, springs or vertices (default: surface)");
    command.add_option("--save", options.save, "File for the state at the end, to resume from");
    command.add_option("--save-frames", options.saveFrames, "Frames to save (default: the last)")
        ->delimiter(',')
        ->check(wholeNumber());
    command.add_option("--resume", options.resume,
                       "Go on from the state in this file; --frames are further ones");
    command.add_flag("--no-watchdog", options.unwatched, "Go on when the state is not finite or too fast");
    command.add_flag("--timings", options.timings, "Measure the time of each pass");
    command.add_option("--screenshot", options.screenshot,
                       "Window: save its picture after --frames and close");
}

// What `shoal bench` measures beside the simulation's frames, each in a file bench_<word>.cpp.
const std::vector<std::string> benchWords = {"sort", "collide", "particles", "school"};

void addBench(CLI::App& command, Options& options, Texts& texts) {
    command.add_option(
        "of", options.benchOf,
        "sort: the sorts; collide: contact; particles: points; school: fish; nothing: frames of "
        "molecules");
    addContext(command, options, texts);
    command.add_flag("--quick", options.quick, "Small groups only, and less time: about half a minute");
    command.add_option("--seconds", options.seconds, "Time for each group of cases (default 12, quick 2)")
        ->check(kindOf(isAll<double>, "a time in seconds"));
    command.add_option("--only", options.only, "Only cases with this in their name, such as \"fish\"");
    command.add_option("--plot", options.plot, "Time per molecule against their number (.svg or .png)");
}

void addMeasure(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("scene", options.files, "Scene file (.scene.json)")->expected(1);
    addError(command, options);
    command.add_option("--solvers", texts.solvers, "Only these, such as euler,leapfrog")->delimiter(',');
    command.add_option("--samplings", texts.samplings, "Only these, such as vertexFrame")->delimiter(',');
    command.add_option("--duration", options.duration, "Simulated seconds after which the error is taken")
        ->check(kindOf(isAll<double>, "a time in seconds"))
        ->capture_default_str();
    command.add_option("--molecules", options.molecules, "Molecules of each group whose error is measured")
        ->check(wholeNumber())
        ->capture_default_str();
    command.add_option("--seconds", options.seconds, "About how long to measure; leaves out what is dearest")
        ->check(kindOf(isAll<double>, "a time in seconds"));
    command.add_flag("--fine", options.fine, "Steps by the square root of 2 instead of 2");
    command.add_option("--csv", options.csv, "Every point as a row of this file");
    command.add_option("--plot", options.plot, "Error against time (.svg or .png)");
    command.add_option("--report", options.report,
                       "Measures the report's own scenes into this folder, and goes on where it was ended");
    command.add_option("--only", options.only,
                       "With --report: scenes with this in their name, such as leaf-fall");
    command
        .add_option("--count", options.count,
                    "Molecules in each group that is placed at random; places where they are born")
        ->check(wholeNumber());
    command.add_option("--seed", options.seed, "Seed of all random numbers, instead of the scene's")
        ->check(kindOf(isAll<uint64_t>, "a whole number from 0 to 18446744073709551615"));
    addPath(command, options, texts);
    addContext(command, options, texts);
}

void addField(CLI::App& command, Options& options, Texts& texts) {
    command.add_option("file", options.files, "Scene (.scene.json), or a model of any format")
        ->required()
        ->expected(1);
    const auto length = [&](const char* option, std::optional<double>& value, const char* what) {
        command.add_option(option, value, what)->check(kindOf(isAll<double>, "a length in m"));
    };
    command
        .add_option("--resolution", options.field.resolution,
                    concat("Cells along the model's longest side (default ", defaultResolution, ")"))
        ->check(wholeNumber());
    length("--error", options.field.error,
           "Instead: refine until no point near the surface is off by more, m");
    length("--shell", options.field.shell, "Thickness of a model that is not closed, m (default two cells)");
    length("--thickness", options.field.thickness, "What vertices keep off the surface, m (default 0.002)");
    command.add_option("--capture", options.capture, "Draw a slice into this file (.png)");
    command.add_option("--slice", texts.slice, "Its plane, such as y=0.5 (default z, through the middle)");
    command.add_option("--size", texts.size, "Largest size of the picture in pixels")->capture_default_str();
    command.add_option("--only", options.only, "Of a scene: fields with this in their name");
    command.add_flag("--json", options.json, "Report as JSON on standard output");
}

void readExportCells(const std::string& word, Options& options) {
    static const std::vector<std::string> words = {"surface", "springs", "vertices"};
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
        throw Error(concat("--export-cells: unknown word \"", word, "\"", suggestion(word, words)));
    options.exportCells = static_cast<ExportCells>(found - words.begin());
    const std::string kind = lowerExtension(options.exports);
    if (options.exportCells != ExportCells::surface && kind != ".vtp" && kind != ".pvd")
        throw Error("--export-cells is of --export to .vtp or .pvd");
}

// x, y or z, and where.
void readSlice(const std::string& text, Options& options) {
    if (text.empty()) return;
    const size_t axis = std::string("xyz").find(text[0]);
    const std::string position = text.size() > 2 ? text.substr(2) : "";
    if (axis == std::string::npos || (text.size() > 1 && (text[1] != '=' || !isAll<double>(position))))
        throw Error(concat("--slice: expected x, y or z and a position such as y=0.5, found \"", text, "\""));
    options.field.sliceAxis = int(axis);
    if (!position.empty()) options.field.slicePosition = std::stod(position);
}

void checkField(const Options& options) {
    if (options.command != Options::Command::field) return;
    const Options::Field& field = options.field;
    if (field.resolution && field.error) throw Error("expected either --resolution or --error, found both");
    if (field.resolution && (*field.resolution < leastResolution || *field.resolution > mostResolution))
        throw Error(concat("--resolution: expected ", leastResolution, " to ", mostResolution, ", found ",
                           *field.resolution));
    const auto above = [](const char* option, const std::optional<double>& value, bool zero) {
        if (value && !(zero ? *value >= 0 : *value > 0 && *value < 1e15))
            throw Error(concat(option, ": expected a length ", zero ? "of at least" : "above", " 0 m, found ",
                               *value));
    };
    above("--error", field.error, false);
    above("--shell", field.shell, false);
    above("--thickness", field.thickness, true);
    if (!options.capture.empty() && lowerExtension(options.capture) != ".png")
        throw Error(concat("--capture: expected a name ending in .png, found \"", options.capture, "\""));
    if (field.sliceAxis && options.capture.empty()) throw Error("--slice needs --capture and a file's name");
}

std::optional<SolverKind> solverNamed(const char* option, const std::string& word) {
    try {
        return solverOf(word);
    } catch (const Error& error) {
        throw Error(concat(option, ": ", error.message()));
    }
}

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
    if (options.command != Options::Command::measure) return;
    if (options.files.empty() == options.report.empty())
        throw Error("measure: expected a scene file, or --report and a folder");
    if (!options.report.empty() && (!options.csv.empty() || !options.plot.empty() || options.json))
        throw Error("--report writes files of its own: leave out --json, --csv and --plot");
    if (options.report.empty() && !options.only.empty()) throw Error("--only chooses scenes of --report");
    if (!(options.duration > 0 && options.duration <= 100))
        throw Error(concat("--duration: expected a time above 0, at most 100 s, found ", options.duration));
    if (options.molecules < 1 || options.molecules > 1024)
        throw Error(concat("--molecules: expected 1 to 1024, found ", options.molecules));
}

void checkBench(const Options& options) {
    if (options.command != Options::Command::bench || options.benchOf.empty()) return;
    const std::string& word = options.benchOf;
    if (std::find(benchWords.begin(), benchWords.end(), word) == benchWords.end())
        throw Error(concat("bench: unknown \"", word, "\"", suggestion(word, benchWords),
                           "; expected sort, collide, particles or nothing"));
    if (!options.plot.empty())
        throw Error(concat("--plot is of bench without a word: leave out \"", word, "\", or it"));
    if (!options.only.empty() && word == "sort")
        throw Error("--only is not of bench sort, which measures everything: leave it out");
}

// The report's scenes have their own.
void checkReport(const Options& options, const CLI::App& measure) {
    if (options.report.empty()) return;
    for (const char* own : {"--duration", "--seed"})
        if (measure.count(own) > 0)
            throw Error(concat("--report: its scenes have their own times and seeds: leave out ", own));
}

// All long option names of a command, for suggestions.
std::vector<std::string> optionNames(CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

std::string explainExtras(CLI::App& app, int argc, char** argv) {
    CLI::App* command = &app;
    while (!command->get_subcommands().empty())
        command = command->get_subcommands().back();
    const std::vector<std::string> names = optionNames(*command);
    for (int i = 1; i < argc; ++i) {
        std::string word = argv[i];
        word = word.substr(0, word.find('='));
        if (word.rfind("--", 0) != 0) continue;
        if (std::find(names.begin(), names.end(), word) == names.end())
            return concat("unknown option ", word, suggestion(word, names));
    }
    std::vector<std::string> commands;
    for (const CLI::App* sub : command->get_subcommands([](CLI::App*) { return true; }))
        commands.push_back(sub->get_name());
    const int word = command == &app ? 1 : 2;
    if (!commands.empty() && argc > word)
        return concat("unknown command \"", argv[word], "\"", suggestion(argv[word], commands));
    return {};
}

// A name with an ending that we do not write is a mistake, not a folder.
void checkTarget(const char* option, const std::string& target, const std::vector<std::string>& known) {
    const std::string extension = lowerExtension(target);
    const bool looksLikeOne = extension.size() >= 4 && extension.size() <= 5 &&
                              std::all_of(extension.begin() + 1, extension.end(),
                                          [](char c) { return std::isalnum(static_cast<unsigned char>(c)); });
    if (!looksLikeOne || std::find(known.begin(), known.end(), extension) != known.end()) return;
    std::string list;
    for (const std::string& one : known)
        list += (list.empty() ? "" : ", ") + one;
    throw Error(
        concat(option, ": cannot write \"", extension, "\"; expected a folder, or a name ending in ", list));
}

void checkRanges(const Options& options) {
    const auto atLeast = [](const char* option, std::optional<int> value, int least) {
        if (value && *value < least)
            throw Error(concat(option, ": expected at least ", least, ", found ", *value));
    };
    // the limits of the scene file
    const auto atMost = [](const char* option, std::optional<int> value, int most) {
        if (value && *value > most)
            throw Error(concat(option, ": expected at most ", most, ", found ", *value));
    };
    atLeast("--frames", options.frames, 1);
    if (options.scale && !(*options.scale >= leastScale && *options.scale <= mostScale))
        throw Error(concat("--scale: expected ", leastScale, " to ", mostScale, ", found ", *options.scale));
    atLeast("--substeps", options.substeps, 1);
    atMost("--substeps", options.substeps, maxSubsteps);
    atLeast("--count", options.count, 1);
    atMost("--count", options.count, maxGroupCount);
    atLeast("--capture-every", options.captureEvery, 1);
    for (const int frame : options.exportFrames)
        atLeast("--export-frames", frame, 0);
    if (options.dt && !(*options.dt >= 1e-5 && *options.dt <= 1))
        throw Error(concat("--dt: expected a time from 1e-5 to 1 s, found ", *options.dt));
    for (const int frame : options.saveFrames)
        atLeast("--save-frames", frame, 0);
    if (!options.saveFrames.empty() && options.save.empty()) throw Error("--save-frames needs --save");
    if (!options.exportFrames.empty() && options.exports.empty())
        throw Error("--export-frames needs --export");
    if (options.exportEvery && options.exports.empty()) throw Error("--export-every needs --export");
    if (options.exportEvery && !options.exportFrames.empty())
        throw Error("--export-every and --export-frames exclude each other");
    atLeast("--export-every", options.exportEvery, 1);
    if (options.captureEvery != 1 && options.capture.empty()) throw Error("--capture-every needs --capture");
    if (!options.capture.empty() && options.captureEvery > options.frames.value_or(headlessFrames))
        throw Error(concat("--capture-every ", options.captureEvery, " is beyond the last frame, ",
                           options.frames.value_or(headlessFrames)));
    if (options.seconds && !(*options.seconds > 0 && *options.seconds <= 3600))
        throw Error(concat("--seconds: expected a time above 0, at most 3600 s, found ", *options.seconds));
    const std::string plot = lowerExtension(options.plot);
    if (!options.plot.empty() && plot != ".svg" && plot != ".png")
        throw Error(concat("--plot: expected a name ending in .svg or .png, found \"", options.plot, "\""));
    checkTarget("--capture", options.capture, {".png", ".mp4", ".mkv", ".webm", ".mov"});
    checkTarget("--export", options.exports, {".csv", ".ply", ".vtp", ".pvd"});
    if (!options.screenshot.empty() && (options.headless || !options.frames))
        throw Error(
            "--screenshot is of the window after --frames: it needs --frames and excludes --headless");
    const bool headlessWork =
        !options.capture.empty() || !options.exports.empty() || options.json || options.timings;
    if (headlessWork && (options.context == gpu::ContextKind::window || !options.screenshot.empty()))
        throw Error(
            "--capture, --export, --json and --timings are of headless runs: leave out the window's options");
    if (options.path == Path::pingPong && (options.inPlace || options.lanes != Lanes::automatic))
        throw Error("--in-place and --lanes are of the fused path: leave out --path ping-pong");
    if (options.shader && (options.path == Path::pingPong || options.json))
        throw Error(
            "--shader prints the fused path's kernels as text: leave out --path ping-pong and --json");
    if (options.fieldSampling) samplingNamed("--field-sampling", *options.fieldSampling);
}

}  // namespace

void parseSize(const std::string& text, Options& options) {
    char end = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &end) != 2 ||
        options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
        throw Error(concat("--size: expected WIDTHxHEIGHT in pixels such as 1280x720, found \"", text, "\""));
}

FieldSampling samplingNamed(const char* option, const std::string& word) {
    std::vector<std::string> words;
    for (const FieldSampling one :
         {FieldSampling::vertexSubstep, FieldSampling::vertexFrame, FieldSampling::moleculeFrame}) {
        if (word == name(one)) return one;
        words.emplace_back(name(one));
    }
    throw Error(concat(option, ": unknown sampling \"", word, "\"", suggestion(word, words)));
}

std::optional<Options> parseOptions(int argc, char** argv) {
    Options options;
    Texts texts;
    CLI::App app("Shoal: very many small mass-spring meshes, simulated and drawn on the GPU", "shoal");
    app.set_version_flag("--version", "shoal " SHOAL_VERSION);
    app.require_subcommand(1);
    CLI::App* run = app.add_subcommand("run", "Run a scene: in a window, or headless with pictures");
    CLI::App* check = app.add_subcommand("check", "Check molecule and scene files");
    CLI::App* explain = app.add_subcommand("explain", "Print what a scene compiles to, and why");
    CLI::App* info = app.add_subcommand("info", "Print the OpenGL contexts that can be had");
    CLI::App* bench = app.add_subcommand("bench", "Measure speed, against the limit and the error");
    CLI::App* measure = app.add_subcommand("measure", "Measure a scene's error against what it costs");
    CLI::App* field = app.add_subcommand("field", "Bake a model's distance field: its error, and a slice");
    CLI::App* edit = app.add_subcommand("edit", "Change a molecule in a window, while it moves");
    addRun(*run, options, texts);
    addEdit(*edit, options, texts);
    check->add_option("files", options.files, "Molecule or scene files")->required();
    check->add_flag("--json", options.json, "Report as JSON on standard output");
    addScene(*explain, options);
    addOverrides(*explain, options, texts);
    addPath(*explain, options, texts);
    explain->add_flag("--shader", options.shader, "Print the fused kernel of each group");
    addContext(*explain, options, texts);
    addError(*explain, options);
    addContext(*info, options, texts);
    addBench(*bench, options, texts);
    addMeasure(*measure, options, texts);
    addField(*field, options, texts);
    addMolecule(app, options);
    for (CLI::App* command : {run, check, explain, measure, field, edit})
        addSandbox(*command, options);
    for (CLI::App* command : app.get_subcommand("molecule")->get_subcommands([](CLI::App*) { return true; }))
        addSandbox(*command, options);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        app.exit(success);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        std::string message = explainExtras(app, argc, argv);
        if (message.empty()) message = error.what();
        throw Error(message + "; see shoal --help");
    }
    options.command = run->parsed()       ? Options::Command::run
                      : check->parsed()   ? Options::Command::check
                      : explain->parsed() ? Options::Command::explain
                      : bench->parsed()   ? Options::Command::bench
                      : measure->parsed() ? Options::Command::measure
                      : field->parsed()   ? Options::Command::field
                      : edit->parsed()    ? Options::Command::edit
                                          : Options::Command::info;
    options.context = gpu::contextKind(texts.context);
    options.path = path(texts.path);
    if (!texts.solver.empty()) options.solver = solverNamed("--solver", texts.solver);
    options.lanes = lanes(texts.lanes);
    readLists(texts, options);
    parseSize(texts.size, options);
    finishMolecule(app, options);
    checkRanges(options);
    readExportCells(texts.exportCells, options);
    readSlice(texts.slice, options);
    checkMeasure(options);
    checkBench(options);
    checkField(options);
    checkReport(options, *measure);
    return options;
}

void apply(const Options& options, Scene& scene) {
    if (options.dt) scene.frameRate = 1 / *options.dt;
    if (options.solver) scene.solver.kind = *options.solver;
    if (options.fieldSampling)
        scene.solver.fieldSampling = samplingNamed("--field-sampling", *options.fieldSampling);
    if (options.substeps) scene.solver.substeps = *options.substeps;
    if (options.seed) scene.seed = *options.seed;
    if (!options.count) return;
    for (Group& group : scene.groups) {
        const bool counted =
            group.place.kind == Placement::Kind::grid || group.place.kind == Placement::Kind::list;
        const bool startsEmpty = group.life && group.count == 0;
        if (!counted && !startsEmpty) group.count = *options.count;
        if (group.life) group.life->capacity = std::max(*options.count, group.count);
    }
}

}  // namespace shoal::app
