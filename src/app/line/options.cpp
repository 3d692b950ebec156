#include "app/line/options.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>
#include <limits>

#include "app/line/cli.h"
#include "app/line/commands.h"
#include "author/shapes.h"
#include "core/file.h"
#include "render/picture.h"
#include "scene/json/scene_file.h"
#include "window/interface.h"

namespace shoal::app {

namespace {

void addSandbox(CLI::App& command, Options& options) {
    section(command, execution);
    command.add_flag("--sandbox", options.sandbox,
                     "Open nothing outside the file's own folder and the shipped data, links followed");
}

void addLenient(CLI::App& command, Options& options) {
    section(command, execution);
    command.add_flag("--lenient", options.lenient,
                     "Read models of which shape, place or mass is lost, and warn of it");
}

}  // namespace

void addScene(CLI::App& command, Options& options) {
    command.add_option("scene", options.files, "Scene file (.scene.json), or a name that shoal scenes lists")
        ->required()
        ->expected(1)
        ->type_name("SCENE");
}

void addOverrides(CLI::App& command, Options& options) {
    section(command, ofScene);
    addNumber(command, "--dt", options.dt, "Seconds that one frame simulates, instead of the scene's",
              "a time from 1e-5 to 1 s", [](double s) { return s >= 1e-5 && s <= 1; });
    addRead(command, "--solver", "Method of every group, instead of the scene's",
            [&options](const std::string& word) { options.solver = solverOf(word); })
        ->type_name(joined(solverWords(), "|"));
    addWhole(command, "--substeps", options.substeps, "Substeps of a frame, instead of the scene's", 1,
             maxSubsteps);
    addRead(command, "--field-sampling", "Where and how often fields are read, instead of the scene's",
            [&options](const std::string& word) { options.sampling = samplingOf(word); })
        ->type_name("vertexSubstep|vertexFrame|moleculeFrame");
    addCountAndSeed(command, options);
}

void addError(CLI::App& command, Options& options, const std::string& what) {
    addNumber(command, "--error", options.error, what, "a relative error above 0, at most 1",
              [](double e) { return e > 0 && e <= 1; });
}

namespace {

void addCheapest(CLI::App& command, Options& options) {
    addError(command, options,
             "Cheapest solver, substeps and field sampling whose measured error is below this");
    addNumber(command, "--error-seconds", options.errorSeconds,
              "Seconds in which --error is to find it (default 60)", "a time from 1 to 1e6 s",
              [](double s) { return s >= 1 && s <= 1e6; });
    needs(command, "--error-seconds", "--error");
}

void addScale(CLI::App& command, Options& options, const std::string& what) {
    addNumber(command, "--scale", options.scale, what,
              concat("a factor from ", window::leastScale, " to ", window::mostScale),
              [](double s) { return s >= window::leastScale && s <= window::mostScale; });
}

void addEdit(CLI::App& command, Options& options) {
    addFile(command, "file", options.files,
            "Molecule file, or scene (.scene.json); one that is not there is begun")
        ->required()
        ->expected(1);
    command.add_option("--shape", options.editShape, "What a new molecule begins as (default sheet)")
        ->check(oneOf(shapeNames()))
        ->type_name(joined(shapeNames(), "|"));
    addSize(command, options, "Size of the window in pixels");
    addScale(command, options, "Pixels a point of the panels; as the screen asks unless given");
    addWhole(command, "--frames", options.frames, "Close after so many frames", 1);
    addFile(command, "--screenshot", options.screenshot, "With --frames: a picture of the last, as PNG");
    needs(command, "--screenshot", "--frames");
}

void addRun(CLI::App& command, Options& options) {
    command
        .add_option(
            "scene", options.files,
            "Scene file (.scene.json), or a name that shoal scenes lists; nothing, or a folder: lists "
            "those to choose from")
        ->expected(0, 1)
        ->type_name("SCENE");
    section(command, ofScene);
    addCheapest(command, options);
    addOverrides(command, options);
    addPath(command, options);
    addContext(command, options);
    section(command, execution);
    command.add_flag("--headless", options.headless, "No window, even where there is a display");
    addWhole(command, "--frames", options.frames, "Stop after so many frames (headless: 240)", 1);
    command.add_flag("--no-watchdog", options.unwatched, "Go on when the state is not finite or too fast");
    section(command, "Pictures");
    addSize(command, options, "Size of pictures, or of the window, in pixels");
    command
        .add_option("--capture", options.capture,
                    "Folder for PNG frames, a video (.mp4, .mkv, .webm, .mov), or .exr: light, depth and a "
                    "mask of each group")
        ->check(endsIn({".png", ".exr", ".mp4", ".mkv", ".webm", ".mov"}, true))
        ->type_name("TARGET");
    command.add_flag("--transparent", options.transparent,
                     "No sky behind: straight alpha in PNG, .mov and .webm, premultiplied in .exr");
    addWhole(command, "--capture-every", options.captureEvery, "Take every n-th frame", 1)
        ->capture_default_str();
    section(command, "State");
    command
        .add_option("--export", options.exports,
                    "Folder (CSV), or a name ending in .csv, .ply, .vtp, or .pvd (an index and .vtp files)")
        ->check(endsIn({".csv", ".ply", ".vtp", ".pvd"}, true))
        ->type_name("TARGET");
    addWhole(command, "--export-frames", options.exportFrames, "Frames to export (default: the last)", 0)
        ->delimiter(',');
    addWhole(command, "--export-every", options.exportEvery, "Export every n-th frame (.pvd: default 1)", 1);
    addWord(command, "--export-cells", options.exportCells, ".vtp, .pvd: what becomes cells",
            {"surface", "springs", "vertices"});
    addFile(command, "--save", options.save, "File for the state at the end, to resume from");
    addWhole(command, "--save-frames", options.saveFrames, "Frames to save (default: the last)", 0)
        ->delimiter(',');
    addFile(command, "--resume", options.resume,
            "Go on from the state in this file; --frames are further ones");
    section(command, reports);
    command.add_flag("--timings", options.timings,
                     "Measure the time of each stage, whose passes explain --passes lists");
    addReads(command, "--require", "End with exit code 3 when it no longer holds: \"strain<0.1, error<1e-3\"",
             [&options](const std::string& text) {
                 for (measure::Requirement& each : measure::requirementsOf(text))
                     options.requirements.push_back(std::move(each));
             });
    command.add_flag_callback(
        "--no-diagnostics", [&options] { options.diagnostics = false; },
        "Tell nothing of strain, contacts and error, and read nothing for it");
    section(command, "Window");
    addScale(command, options, "Size of panels and letters, such as 2 (default: as the screen asks)");
    addFile(command, "--screenshot", options.screenshot, "Save its picture after --frames and close");
    needs(command, "--save-frames", "--save");
    needs(command, "--export-frames", "--export");
    needs(command, "--export-every", "--export");
    needs(command, "--export-cells", "--export");
    needs(command, "--capture-every", "--capture");
    needs(command, "--transparent", "--capture");
    needs(command, "--screenshot", "--frames");
    excludes(command, "--export-every", {"--export-frames"});
    excludes(command, "--screenshot",
             {"--headless", "--capture", "--export", "--json", "--timings", "--gpu", "--require"});
    excludes(command, "--require", {"--no-diagnostics", "--timings"});
}

// All long option names of a command, for suggestions.
std::vector<std::string> optionNames(CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

// Stands for the nothing of "--save=", which CLI11 drops to take the next word in its place.
constexpr const char* nothing = "--";

// Every option of a command and of those below it is written the same way: one that takes a value takes one
// each time, so that it leaves the words behind it alone; neither nothing nor another option is a value; and
// one that takes none takes none behind an "=" either.
void holdToOneValue(CLI::App& command) {
    const CLI::Validator aValue(
        [](const std::string& text) {
            if (text.empty() || text == nothing) return std::string("expected a value, found nothing");
            if (text.rfind("--", 0) == 0)
                return concat("expected a value, found the option ", text, " (a file of that name is ./",
                              text, ")");
            return std::string();
        },
        "");
    for (CLI::Option* option : command.get_options()) {
        if (option->get_items_expected_max() == 0) {
            option->disable_flag_override();
            continue;
        }
        option->check(aValue);
        if (option->nonpositional()) option->allow_extra_args(false);
#if CLI11_VERSION_MAJOR > 2 || CLI11_VERSION_MINOR >= 6  // a wrong value is told before what else is needed
        option->callback_priority(CLI::CallbackPriority::PreRequirementsCheck);
#endif
    }
    for (CLI::App* below : command.get_subcommands([](CLI::App*) { return true; }))
        holdToOneValue(*below);
}

// The words of the command line, the last first, as CLI11 takes them.
std::vector<std::string> wordsBackwards(int argc, char** argv) {
    std::vector<std::string> out;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool ofNothing = word.rfind("--", 0) == 0 && word.find('=') == word.size() - 1;
        out.push_back(ofNothing ? word + nothing : word);
    }
    std::reverse(out.begin(), out.end());
    return out;
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

// Error: options of run or explain that do not go together.
void checkTogether(const Options& options) {
    if (!options.capture.empty() && options.captureEvery > options.frames.value_or(headlessFrames))
        throw Error(concat("--capture-every ", options.captureEvery, " is beyond the last frame, ",
                           options.frames.value_or(headlessFrames)));
    if (options.transparent && isVideo(options.capture) && !isVideoWithAlpha(options.capture))
        throw Error(concat("--transparent: ", lowerExtension(options.capture),
                           " has no alpha; .mov (ProRes 4444), .webm (VP9), .png and .exr have"));
    const std::string kind = lowerExtension(options.exports);
    if (options.exportCells != ExportCells::surface && kind != ".vtp" && kind != ".pvd")
        throw Error("--export-cells is of --export to .vtp or .pvd");
    const bool headlessWork = !options.capture.empty() || !options.exports.empty() || options.json ||
                              options.timings || !options.requirements.empty();
    if (headlessWork && options.context == gpu::ContextKind::window)
        throw Error(
            "--capture, --export, --json, --timings and --require are of headless runs: leave out the "
            "window's options");
    const bool mayCompute = options.path == Path::automatic || options.path == Path::fused;
    if (!mayCompute && (options.inPlace || options.lanes != Lanes::automatic))
        throw Error(
            concat("--in-place and --lanes are of compute shaders: leave out --path ", name(options.path)));
    if (options.shader && (options.path == Path::pingPong || options.json))
        throw Error(
            "--shader prints the fused path's kernels as text: leave out --path ping-pong and --json");
}

void readSize(const std::string& text, Options& options) {
    const size_t cross = text.find('x');
    constexpr int most = 16384;
    const auto side = [](const std::string& digits, int& value) {
        return isAll(digits, value) && value >= 1 && value <= most;
    };
    if (cross == std::string::npos || !side(text.substr(0, cross), options.width) ||
        !side(text.substr(cross + 1), options.height))
        throw Error(concat("expected WIDTHxHEIGHT in pixels, each from 1 to ", most,
                           ", such as 1280x720, found \"", text, "\""));
}

}  // namespace

CLI::Validator oneOf(const std::vector<std::string>& words) {
    return CLI::Validator(
        [words](const std::string& word) {
            if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
            return concat("unknown word \"", word, "\"", suggestion(word, words));
        },
        "");
}

CLI::Validator endsIn(const std::vector<std::string>& endings, bool orFolder) {
    return CLI::Validator(
        [endings, orFolder](const std::string& name) {
            const std::string ending = lowerExtension(name);
            const bool isEnding = ending.size() >= 4 && ending.size() <= 5 &&
                                  std::all_of(ending.begin() + 1, ending.end(), [](char c) {
                                      return std::isalnum(static_cast<unsigned char>(c));
                                  });
            if ((orFolder && !isEnding) || std::find(endings.begin(), endings.end(), ending) != endings.end())
                return std::string();
            return concat("expected ", orFolder ? "a folder, or " : "", "a name ending in ",
                          joined(endings, " or "), ", found \"", name, "\"");
        },
        "");
}

CLI::Option* addSize(CLI::App& command, Options& options, const std::string& what) {
    return addRead(command, "--size", what, [&options](const std::string& text) { readSize(text, options); })
        ->type_name("WxH")
        ->default_str(concat(options.width, "x", options.height));
}

static void declare(CLI::App& app, Options& options) {
    app.set_version_flag("--version", "shoal " SHOAL_VERSION);
    app.require_subcommand(1);
    app.formatter(helpFormat());
    const auto add = [&app](const char* name, const char* what, const char* group) {
        CLI::App* out = app.add_subcommand(name, what);
        out->group(group);
        return out;
    };
    const char *scenes = "Scenes", *molecules = "Molecules", *machine = "This machine";
    addRun(*add("run", "Run a scene: in a window, or headless with pictures", scenes), options);
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
    addOverrides(*explain, options);
    addCheapest(*explain, options);
    addPath(*explain, options);
    addContext(*explain, options);
    explain->add_flag("--shader", options.shader, "Print the fused kernel of each group");
    explain->add_flag("--cost", options.cost,
                      "What each kernel moves and computes, and which of these bounds it on this device");
    explain->add_flag("--passes", options.passes,
                      "What one frame asks of this device, pass by pass, and what each reads and writes");
    excludes(*explain, "--cost", {"--shader"});
    excludes(*explain, "--passes", {"--shader"});
    addMeasure(*add("measure", "Measure a scene's error against what it costs", scenes), options);
    addField(*add("field", "Bake a model's distance field: its error, and a slice", scenes), options);
    addExport(*add("export", "Write a scene for game engines and viewers", scenes), options);
    addEdit(*add("edit", "Change a molecule or a scene in a window, while it moves", molecules), options);
    addMolecule(app, options);
    app.get_subcommand("molecule")->group(molecules);
    addContext(*add("info", "Print the OpenGL contexts that can be had", machine), options);
    addBench(*add("bench", "Measure speed, against the limit and the error", machine), options);
    for (const char* name : {"run", "check", "explain", "measure", "field", "export", "edit"})
        addSandbox(*app.get_subcommand(name), options);
    for (CLI::App* command : app.get_subcommand("molecule")->get_subcommands([](CLI::App*) { return true; }))
        addSandbox(*command, options);
    for (const char* name : {"run", "check", "explain", "measure", "field", "export", "edit"})
        addLenient(*app.get_subcommand(name), options);
    addLenient(*app.get_subcommand("molecule")->get_subcommand("from-mesh"), options);
    // Last, so that commands do not take it over.
    app.footer(
        "shoal COMMAND --help has the options of a command.\n"
        "Exit codes: 0 when all went well, 1 when a run failed or a file is wrong, 2 when the command line "
        "is wrong, 3 when what --require asks for does not hold.");
    // The installation is made with the first two (cmake/ShoalInstall.cmake), docs/command.md with the last.
    const auto document = [&app](const char* flag, std::string (*write)(const CLI::App&)) {
        CLI::Option* option = app.add_flag_callback(flag, [&app, write] {
            std::cout << write(app);
            throw CLI::Success();
        });
        option->group("");
#if CLI11_VERSION_MAJOR > 2 || CLI11_VERSION_MINOR >= 6  // where a command is missed before flags are called
        option->callback_priority(CLI::CallbackPriority::First);
#endif
    };
    holdToOneValue(app);
    document("--man-page", manPage);
    document("--bash-completion", bashCompletion);
    document("--markdown", markdown);
}

// CLI11's words for "--json=5" without the dashes of the name; empty: it says something else.
static std::string takesNoValue(const std::string& message) {
    const size_t end = message.find(" was given a disallowed flag override");
    return end == std::string::npos ? "" : "--" + message.substr(0, end) + ": takes no value";
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

static void finish(const CLI::App& app, Options& options) {
    options.command = commandOf(app);
    finishMolecule(app, options);
    checkTogether(options);
    finishMeasure(options);
    finishExport(options);
}

std::optional<Options> parseOptions(int argc, char** argv) {
    Options options;
    CLI::App app("Shoal: very many small mass-spring meshes, simulated and drawn on the GPU", "shoal");
    declare(app, options);
    try {
        app.parse(wordsBackwards(argc, argv));
    } catch (const CLI::Success& success) {
        app.exit(success);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        // What an option takes is told first, since that error names it.
        const std::string told = error.what();
        const bool namesOption =
            told.rfind('-', 0) == 0 && (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr ||
                                        dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr);
        std::string message = takesNoValue(told);
        if (message.empty() && !namesOption) message = explainExtras(app, argc, argv);
        if (message.empty()) message = told;
        throw WrongUse(message + "; see " + nameOf(reached(app)) + " --help");
    }
    try {
        finish(app, options);
    } catch (const Error& error) {
        throw WrongUse(error.message());
    }
    return options;
}

}  // namespace shoal::app
