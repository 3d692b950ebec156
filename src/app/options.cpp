#include "app/options.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>
#include <limits>

#include "app/cli.h"
#include "app/commands.h"
#include "author/shapes.h"
#include "core/file.h"
#include "scene/json/scene_file.h"
#include "window/interface.h"

namespace shoal::app {

namespace {

void addSandbox(CLI::App& command, Options& options) {
    section(command, execution);
    command.add_flag("--sandbox", options.sandbox,
                     "Open nothing outside the file's own folder and the shipped data, links followed");
}

}  // namespace

void addScene(CLI::App& command, Options& options) {
    command.add_option("scene", options.files, "Scene file (.scene.json), or a name that shoal scenes lists")
        ->required()
        ->expected(1)
        ->type_name("SCENE");
}

void addOverrides(CLI::App& command, Options& options, Texts& texts) {
    section(command, ofScene);
    addNumber(command, "--dt", options.dt, "Seconds that one frame simulates, instead of the scene's",
              "a time in seconds");
    command.add_option("--solver", texts.solver, "Method of every group, instead of the scene's")
        ->type_name(joined(solverWords(), "|"));
    addWhole(command, "--substeps", options.substeps, "Substeps of a frame, instead of the scene's");
    command
        .add_option("--field-sampling", options.fieldSampling,
                    "Where and how often fields are read, instead of the scene's")
        ->type_name("vertexSubstep|vertexFrame|moleculeFrame");
    addCountAndSeed(command, options);
}

namespace {

void addError(CLI::App& command, Options& options) {
    section(command, ofScene);
    addNumber(command, "--error", options.error,
              "Cheapest solver, substeps and field sampling whose measured error is below this",
              "an error such as 1e-3");
}

void addEdit(CLI::App& command, Options& options, Texts& texts) {
    addFile(command, "file", options.files,
            "Molecule file, or scene (.scene.json); one that is not there is begun")
        ->required()
        ->expected(1);
    command.add_option("--shape", options.editShape, "What a new molecule begins as (default sheet)")
        ->type_name(joined(shapeNames(), "|"));
    command.add_option("--size", texts.size, "Size of the window in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    addNumber(command, "--scale", options.scale,
              "Pixels a point of the panels; as the screen asks unless given", "a number");
    addWhole(command, "--frames", options.frames, "Close after so many frames");
    addFile(command, "--screenshot", options.screenshot, "With --frames: a picture of the last, as PNG");
    needs(command, "--screenshot", "--frames");
}

void addRun(CLI::App& command, Options& options, Texts& texts) {
    command
        .add_option(
            "scene", options.files,
            "Scene file (.scene.json), or a name that shoal scenes lists; nothing, or a folder: lists "
            "those to choose from")
        ->expected(0, 1)
        ->type_name("SCENE");
    addError(command, options);
    addOverrides(command, options, texts);
    addPath(command, options, texts);
    addContext(command, options, texts);
    section(command, execution);
    command.add_flag("--headless", options.headless, "No window, even where there is a display");
    addWhole(command, "--frames", options.frames, "Stop after so many frames (headless: 240)");
    command.add_flag("--no-watchdog", options.unwatched, "Go on when the state is not finite or too fast");
    section(command, "Pictures");
    command.add_option("--size", texts.size, "Size of pictures, or of the window, in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command
        .add_option("--capture", options.capture,
                    "Folder for PNG frames, or a video (.mp4, .mkv, .webm, .mov)")
        ->type_name("TARGET");
    addWhole(command, "--capture-every", options.captureEvery, "Take every n-th frame")
        ->capture_default_str();
    section(command, "State");
    command
        .add_option("--export", options.exports,
                    "Folder (CSV), or a name ending in .csv, .ply, .vtp, or .pvd (an index and .vtp files)")
        ->type_name("TARGET");
    addWhole(command, "--export-frames", options.exportFrames, "Frames to export (default: the last)")
        ->delimiter(',');
    addWhole(command, "--export-every", options.exportEvery, "Export every n-th frame (.pvd: default 1)");
    command.add_option("--export-cells", texts.exportCells, ".vtp, .pvd: what becomes cells")
        ->type_name("surface|springs|vertices")
        ->capture_default_str();
    addFile(command, "--save", options.save, "File for the state at the end, to resume from");
    addWhole(command, "--save-frames", options.saveFrames, "Frames to save (default: the last)")
        ->delimiter(',');
    addFile(command, "--resume", options.resume,
            "Go on from the state in this file; --frames are further ones");
    section(command, reports);
    command.add_flag("--timings", options.timings, "Measure the time of each pass");
    section(command, "Window");
    addNumber(command, "--scale", options.scale,
              "Size of panels and letters, such as 2 (default: as the screen asks)", "a factor such as 1.5");
    addFile(command, "--screenshot", options.screenshot, "Save its picture after --frames and close");
    needs(command, "--save-frames", "--save");
    needs(command, "--export-frames", "--export");
    needs(command, "--export-every", "--export");
    needs(command, "--export-cells", "--export");
    needs(command, "--capture-every", "--capture");
    needs(command, "--screenshot", "--frames");
    excludes(command, "--export-every", {"--export-frames"});
    excludes(command, "--screenshot",
             {"--headless", "--capture", "--export", "--json", "--timings", "--gpu"});
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
    throw Error(concat(option, ": cannot write \"", extension, "\"; expected a folder, or a name ending in ",
                       joined(known, ", ")));
}

void checkRanges(const Options& options) {
    constexpr int any = std::numeric_limits<int>::max();
    const auto within = [](const char* option, std::optional<int> value, int least, int most) {
        if (value && *value < least)
            throw Error(concat(option, ": expected at least ", least, ", found ", *value));
        if (value && *value > most)
            throw Error(concat(option, ": expected at most ", most, ", found ", *value));
    };
    within("--gpu", options.gpu, 0, any);
    within("--frames", options.frames, 1, any);
    if (options.scale && !(*options.scale >= window::leastScale && *options.scale <= window::mostScale))
        throw Error(concat("--scale: expected ", window::leastScale, " to ", window::mostScale, ", found ",
                           *options.scale));
    // the limits of the scene file
    within("--substeps", options.substeps, 1, maxSubsteps);
    within("--count", options.count, 1, maxGroupCount);
    within("--capture-every", options.captureEvery, 1, any);
    for (const int frame : options.exportFrames)
        within("--export-frames", frame, 0, any);
    if (options.dt && !(*options.dt >= 1e-5 && *options.dt <= 1))
        throw Error(concat("--dt: expected a time from 1e-5 to 1 s, found ", *options.dt));
    for (const int frame : options.saveFrames)
        within("--save-frames", frame, 0, any);
    within("--export-every", options.exportEvery, 1, any);
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
    const bool headlessWork =
        !options.capture.empty() || !options.exports.empty() || options.json || options.timings;
    if (headlessWork && options.context == gpu::ContextKind::window)
        throw Error(
            "--capture, --export, --json and --timings are of headless runs: leave out the window's options");
    const bool mayCompute = options.path == Path::automatic || options.path == Path::fused;
    if (!mayCompute && (options.inPlace || options.lanes != Lanes::automatic))
        throw Error(
            concat("--in-place and --lanes are of compute shaders: leave out --path ", name(options.path)));
    if (options.shader && (options.path == Path::pingPong || options.json))
        throw Error(
            "--shader prints the fused path's kernels as text: leave out --path ping-pong and --json");
}

}  // namespace

void parseSize(const std::string& text, Options& options) {
    char end = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &end) != 2 ||
        options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
        throw Error(concat("--size: expected WIDTHxHEIGHT in pixels such as 1280x720, found \"", text, "\""));
}

static void declare(CLI::App& app, Options& options, Texts& texts) {
    app.set_version_flag("--version", "shoal " SHOAL_VERSION);
    app.require_subcommand(1);
    app.formatter(helpFormat());
    const auto add = [&app](const char* name, const char* what, const char* group) {
        CLI::App* out = app.add_subcommand(name, what);
        out->group(group);
        return out;
    };
    const char *scenes = "Scenes", *molecules = "Molecules", *machine = "This machine";
    addRun(*add("run", "Run a scene: in a window, or headless with pictures", scenes), options, texts);
    add("scenes", "List the scenes that ship, or those below a folder", scenes)
        ->add_option("folder", options.files, "Folder to look in (default: what ships)")
        ->expected(0, 1)
        ->type_name("FOLDER");
    CLI::App* check = add("check", "Check molecule and scene files", scenes);
    check->add_option("files", options.files, "Molecule or scene files, or names that shoal scenes lists")
        ->required()
        ->type_name("FILE");
    check->add_flag("--json", options.json, "Report as JSON on standard output");
    add("keys", "Print what scene, molecule and layout files may say", scenes)
        ->add_option("names", options.files,
                     "Objects or keys, such as emitters or radius (default: all objects)")
        ->type_name("NAME");
    CLI::App* explain = add("explain", "Print what a scene compiles to, and why", scenes);
    addScene(*explain, options);
    addOverrides(*explain, options, texts);
    addError(*explain, options);
    addPath(*explain, options, texts);
    addContext(*explain, options, texts);
    explain->add_flag("--shader", options.shader, "Print the fused kernel of each group");
    explain->add_flag("--cost", options.cost,
                      "What each kernel moves and computes, and which of these bounds it on this device");
    excludes(*explain, "--cost", {"--shader"});
    addMeasure(*add("measure", "Measure a scene's error against what it costs", scenes), options, texts);
    addField(*add("field", "Bake a model's distance field: its error, and a slice", scenes), options,
             texts.slice, texts.size);
    addExport(*add("export", "Write a scene for game engines and viewers", scenes), options, texts);
    addEdit(*add("edit", "Change a molecule or a scene in a window, while it moves", molecules), options,
            texts);
    addMolecule(app, options);
    app.get_subcommand("molecule")->group(molecules);
    addContext(*add("info", "Print the OpenGL contexts that can be had", machine), options, texts);
    addBench(*add("bench", "Measure speed, against the limit and the error", machine), options, texts);
    for (const char* name : {"run", "check", "explain", "measure", "field", "export", "edit"})
        addSandbox(*app.get_subcommand(name), options);
    for (CLI::App* command : app.get_subcommand("molecule")->get_subcommands([](CLI::App*) { return true; }))
        addSandbox(*command, options);
    // Last, so that commands do not take it over.
    app.footer(
        "shoal COMMAND --help has the options of a command.\n"
        "Exit codes: 0 when all went well, 1 when a run failed or a file is wrong, 2 when the command line "
        "is "
        "wrong.");
    // The installation is made with the first two (cmake/ShoalInstall.cmake), docs/command.md with the last.
    const auto document = [&app](const char* flag, std::string (*write)(const CLI::App&)) {
        app.add_flag_callback(flag,
                              [&app, write] {
                                  std::cout << write(app);
                                  throw CLI::Success();
                              })
            ->group("");
    };
    document("--man-page", manPage);
    document("--bash-completion", bashCompletion);
    document("--markdown", markdown);
}

// The command that the words on the command line have come to.
static const CLI::App* reached(const CLI::App& app) {
    const CLI::App* out = &app;
    while (!out->get_subcommands().empty())
        out = out->get_subcommands().back();
    return out;
}

static std::string nameOf(const CLI::App* command) {
    return (command->get_parent() ? nameOf(command->get_parent()) + " " : "") + command->get_name();
}

static auto commandOf(const CLI::App& app) {
    static constexpr std::pair<const char*, int (*)(const Options&)> names[] = {
        {"run", runCommand},         {"scenes", scenesCommand}, {"check", checkCommand},
        {"explain", explainCommand}, {"bench", benchCommand},   {"measure", measureCommand},
        {"field", fieldCommand},     {"edit", editCommand},     {"keys", keysCommand},
        {"export", exportCommand},
    };
    for (const auto& [name, command] : names)
        if (app.got_subcommand(name)) return command;
    return infoCommand;
}

static void finish(const CLI::App& app, Options& options, const Texts& texts) {
    options.command = commandOf(app);
    options.context = gpu::contextKind(texts.context);
    options.path = path(texts.path);
    if (!texts.solver.empty()) options.solver = solverNamed("--solver", texts.solver);
    options.lanes = lanes(texts.lanes);
    parseSize(texts.size, options);
    finishMolecule(app, options);
    checkRanges(options);
    if (options.fieldSampling) options.sampling = samplingNamed("--field-sampling", *options.fieldSampling);
    readExportCells(texts.exportCells, options);
    checkField(options, texts.slice);
    finishMeasure(texts, options);
    finishExport(options);
}

std::optional<Options> parseOptions(int argc, char** argv) {
    Options options;
    Texts texts;
    CLI::App app("Shoal: very many small mass-spring meshes, simulated and drawn on the GPU", "shoal");
    declare(app, options, texts);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        app.exit(success);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        std::string message = explainExtras(app, argc, argv);
        if (message.empty()) message = error.what();
        throw WrongUse(message + "; see " + nameOf(reached(app)) + " --help");
    }
    try {
        finish(app, options, texts);
    } catch (const Error& error) {
        throw WrongUse(error.message());
    }
    return options;
}

}  // namespace shoal::app
