#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "app/export/export.h"
#include "app/line/commands.h"
#include "app/measure/measure.h"
#include "app/run/picture_layers.h"
#include "app/run/report.h"
#include "app/run/run_diagnostics.h"
#include "core/data_paths.h"
#include "core/error.h"
#include "core/file.h"
#include "core/json.h"
#include "core/printable.h"
#include "gpu/program_cache.h"
#include "render/picture.h"
#include "render/renderer.h"
#include "run/checkpoints.h"
#include "run/progress.h"
#include "run/scene_list.h"
#include "run/signals.h"
#include "simulate/fused.h"
#include "simulate/simulation.h"
#include "window/windows.h"

namespace shoal::app {

namespace fs = std::filesystem;

namespace {

bool wantsWindow(const Options& options) {
    if (options.headless) {
        if (options.context == gpu::ContextKind::window)
            throw WrongUse("--headless and --context window exclude each other");
        return false;
    }
    if (options.gpu) return false;
    if (options.context == gpu::ContextKind::window) return true;
    // pictures, exports and reports are headless work unless a window is asked for
    const bool batch = !options.capture.empty() || !options.exports.empty() || options.json ||
                       options.timings || !options.requirements.empty();
    return options.context == gpu::ContextKind::automatic && gpu::hasDisplay() && !batch;
}

// The pictures of a run that asked for none: eight of them, in a folder named after the scene.
std::string defaultFolder(const std::string& sceneFile) {
    return "pictures/" + sceneStem(sceneFile);
}

// Such a run writes pictures.
bool asksForNothing(const Options& options) {
    return options.capture.empty() && options.exports.empty() && options.save.empty() && !options.json &&
           !options.timings && options.requirements.empty();
}

SimulationOptions simulationOptions(const Options& options, gpu::Context& context) {
    SimulationOptions out;
    if (options.timings) out.timing = gpu::PassTimers::suitedTo(context.info());
    out.drawn = asksForNothing(options) || !options.capture.empty() || !options.exports.empty();
    out.path = options.path;
    out.lanes = options.lanes;
    out.inPlace = options.inPlace;
    out.watchdog = !options.unwatched;
    return out;
}

// Error: one of them lies beyond the last, or before the first, which is 0 unless the run was resumed.
void checkFrames(const char* option, const std::vector<int>& frames, int first, int last) {
    for (const int frame : frames) {
        if (frame > last) throw WrongUse(concat(option, ": frame ", frame, " is beyond the last, ", last));
        if (frame < first)
            throw WrongUse(
                concat(option, ": frame ", frame, " is before ", first, ", where the run goes on"));
    }
}

// Returns the folder of the files that a run writes.
std::string outputFolder(const Options& options) {
    if (!options.save.empty()) return fs::path(options.save).parent_path().string();
    const std::string target = options.capture.empty() ? options.exports : options.capture;
    return lowerExtension(target).empty() ? target : fs::path(target).parent_path().string();
}

// One headless run, step by step; keeps the bytes of frames apart from those of captures and exports.
class HeadlessRun {
  public:
    HeadlessRun(const Options& options, gpu::Context& context, Loaded loaded)
        : options_(options),
          context_(context),
          frames_(options.frames.value_or(headlessFrames)),
          scene_(std::move(loaded.scene)),
          simulation_(context, std::move(loaded.plan), simulationOptions(options, context)) {
        tellWarnings(simulation_.warnings());
        tellWarnings(context.cache().takeWarnings());
        report_.scene = options.files.front();
        resume(options, simulation_);
        first_ = simulation_.frames();
        if (frames_ > std::numeric_limits<int>::max() - first_)
            throw WrongUse(concat("--frames: ", frames_, " after frame ", first_, " are too many to count"));
        last_ = first_ + frames_;
        checkSave(options);
        if (options.diagnostics && !options.timings) diagnostics_.emplace(options, scene_, simulation_);
        const bool nothingAsked = asksForNothing(options);
        const std::string target = nothingAsked ? defaultFolder(options.files.front()) : options.capture;
        every_ = nothingAsked ? std::max(1, frames_ / 8) : options.captureEvery;
        checkFrames("--export-frames", options.exportFrames, first_, last_);
        checkFrames("--save-frames", options.saveFrames, first_, last_);
        exporter_.emplace(options, first_, last_);
        if (target.empty()) return;
        RenderOptions size;
        size.width = options.width;
        size.height = options.height;
        if (options.timings) size.timing = gpu::PassTimers::suitedTo(context.info());
        size.clear = options.transparent;
        size.layers = layered_ = lowerExtension(target) == ".exr";
        if (options.transparent && scene_.water)
            throw WrongUse("--transparent: the water of this scene fills the picture");
        renderer_ = std::make_unique<Renderer>(context, scene_, simulation_.plan(), size);
        pictures_ = std::make_unique<PictureWriter>(target, scene_.frameRate / every_, frames_ > every_,
                                                    last_, options.transparent);
    }

    void go() {
        report_.start = context_.traffic();
        const auto start = std::chrono::steady_clock::now();
        try {
            runFrames();
        } catch (const Runaway& runaway) {
            if (pictures_) pictures_->finish();  // they show how it came about
            throw Error(runaway.location(),
                        concat(runaway.message(), ". ",
                               saveForInspection(outputFolder(options_), scene_.file, simulation_, runaway)));
        }
        if (pictures_) pictures_->finish();
        if (isVideo(target()) && drawn_ > 0) report_.written.push_back(target());
        context_.checkErrors("run");
        simulation_.timers().drain();
        if (renderer_) renderer_->timers().drain();
        report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (diagnostics_) outside([&] { diagnostics_->finish(!signalThatAsked()); });
    }

    void runFrames() {
        Progress progress("frames", frames_);
        outside([&] {
            writeIfAsked(first_);
            diagnose(progress);
        });
        for (int frame = first_ + 1; frame <= last_ && !signalThatAsked() && holds(); ++frame) {
            const gpu::Traffic before = context_.traffic();
            simulation_.frame();
            const bool draws = renderer_ && frame % every_ == 0;
            if (draws)
                renderer_->draw(simulation_.state(), View::fromCamera(scene_.camera, simulation_.time()));
            addTo(report_.frames, context_.traffic() - before);
            outside([&] {
                if (draws) {
                    writePicture(frame);
                    ++drawn_;
                    if (!isVideo(target())) report_.written.push_back(pictures_->last().string());
                }
                writeIfAsked(frame);
                diagnose(progress);
            });
            progress.step();
        }
        outside([&] { writeLast(); });
        simulation_.check();
    }

    // Returns the exit code.
    int tell() {
        report();
        if (holds()) return 0;
        std::cerr << "shoal: " << diagnostics_->broken() << "\n";
        return 3;
    }

    void report() {
        uint64_t hash = 0;
        outside([&] {
            hash = simulation_.hash();
            report_.lives = livesOf(simulation_);
        });
        tellDropped();
        tellStopped();
        if (options_.json) {
            JsonValue out = asJson(report_, simulation_, passTimes(), hash);
            if (options_.timings && drawn_ > 0)
                append(out, key("drawnPrimitives", renderer_->drawnPrimitives()));
            if (diagnostics_) append(out, key("diagnostics", diagnostics_->json()));
            std::cout << writeJson(out);
            return;
        }
        std::cout << many(simulation_.frames() - first_, "frame", "frames") << ", " << simulation_.time()
                  << " s simulated in " << report_.seconds << " s on the " << name(simulation_.path().path)
                  << " path, " << context_.info().renderer << " (" << gpu::name(context_.info().kind)
                  << ")\n";
        tellWritten();
        if (diagnostics_) diagnostics_->print(std::cout);
        for (const GroupLives& lives : report_.lives)
            std::cout << text(lives) << "\n";
        for (const gpu::PassTime& pass : passTimes())
            std::cout << "  " << pass.name << ": min " << pass.min * 1e3 << ", median " << pass.median * 1e3
                      << " ms a frame, in " << many(pass.calls, "call", "calls") << "\n";
        if (options_.timings && drawn_ > 0)
            std::cout << "  molecules in the last picture: " << renderer_->drawnPrimitives()
                      << " points and triangles\n";
    }

  private:
    bool holds() const { return !diagnostics_ || diagnostics_->broken().empty(); }
    void diagnose(Progress& progress) {
        if (diagnostics_ && diagnostics_->follow())
            progress.rename(concat("frames, ", diagnostics_->shortText()));
    }
    void tellDropped() {
        const uint32_t dropped = simulation_.contact() ? simulation_.contact()->dropped() : 0;
        if (dropped == 0) return;
        std::cerr << "shoal: warning: " << dropped
                  << " contacts were left out, because a sphere touched more than "
                  << simulation_.contact()->listLength()
                  << " others: a smaller radius, or molecules that start further apart, touch fewer\n";
    }
    void tellStopped() {
        if (!signalThatAsked()) return;
        std::cerr << "shoal: " << stoppedBySignal() << " after frame " << simulation_.frames() << " of "
                  << last_;
        const std::vector<std::string>& files = report_.written;
        constexpr size_t most = 4;  // to be named
        for (size_t i = 0; i < std::min(files.size(), most); ++i)
            std::cerr << (i ? ", " : "; whole: ") << printable(files[i]);
        if (files.size() > most)
            std::cerr << " and so on to " << printable(files.back()) << ", " << files.size() << " files";
        std::cerr << "\n";
    }
    std::vector<gpu::PassTime> passTimes() {
        return gpu::stagesOf(simulation_.timers(), renderer_ ? &renderer_->timers() : nullptr);
    }
    template <typename Work>
    void outside(const Work& work) {
        const gpu::Traffic before = context_.traffic();
        work();
        addTo(report_.outside, context_.traffic() - before);
    }
    static void addTo(gpu::Traffic& sum, const gpu::Traffic& part) {
        for (int i = 0; i < gpu::Traffic::kinds; ++i) {
            sum.uploaded[i] += part.uploaded[i];
            sum.readBack[i] += part.readBack[i];
        }
    }
    void note(std::vector<std::string>& files, const std::string& file) {
        files.push_back(file);
        report_.written.push_back(file);
    }
    std::string target() const { return pictures_ ? pictures_->target() : std::string(); }

    void writePicture(int frame) {
        if (!layered_) return pictures_->write(renderer_->capture(), frame);
        const View view = View::fromCamera(scene_.camera, simulation_.time());
        writeLayers(pictures_->place(frame), renderer_->layers(simulation_.state(), view));
    }

    // Prints what was written, and where: "pictures: pictures/hello, 8 pictures".
    void tellWritten() {
        if (drawn_ > 0) {
            std::cout << (isVideo(target()) ? "video: " : "pictures: ") << printable(target()) << ", "
                      << drawn_ << (drawn_ == 1 ? " picture\n" : " pictures\n");
        }
        tellFiles("state: ", exported_);
        if (exported_.size() > 1 && lowerExtension(options_.exports) == ".pvd")
            std::cout << "index: " << printable(options_.exports) << "\n";
        tellFiles("saved: ", saved_);
    }
    static void tellFiles(const char* what, const std::vector<std::string>& files) {
        if (files.empty()) return;
        std::cout << what << printable(files.front());
        if (files.size() > 1)
            std::cout << " to " << printable(files.back()) << ", " << files.size() << " files";
        std::cout << "\n";
    }

    // Exports and saves the frame where that was asked for.
    void writeIfAsked(int frame) {
        if (exporter_->asksFor(frame)) note(exported_, exporter_->write(simulation_, scene_));
        if (contains(options_.saveFrames, frame)) save(frame);
    }
    // Exports and saves the last frame where that was asked for; the run may have ended early.
    void writeLast() {
        if (exporter_->asksForLast()) note(exported_, exporter_->write(simulation_, scene_));
        if (options_.saveFrames.empty() && !options_.save.empty()) save(simulation_.frames());
    }
    void save(int frame) {
        const std::string file = numbered(options_.save, frame, options_.saveFrames.size() > 1, last_);
        saveState(file, simulation_);
        note(saved_, file);
    }

    const Options& options_;
    gpu::Context& context_;
    int frames_, every_ = 1;
    int first_ = 0, last_ = 0;  // where the run goes on, where it ends
    Scene scene_;
    Simulation simulation_;
    std::unique_ptr<Renderer> renderer_;
    std::unique_ptr<PictureWriter> pictures_;
    std::optional<Exporter> exporter_;
    std::optional<RunDiagnostics> diagnostics_;
    int drawn_ = 0;         // pictures
    bool layered_ = false;  // .exr
    std::vector<std::string> exported_, saved_;
    RunReport report_;
};

}  // namespace

static std::string folderOf(const Options& options) {
    return options.files.empty() ? modelFolder() : options.files.front();
}

int scenesCommand(const Options& options) {
    const std::string list = listOfScenes(folderOf(options));
    if (list.empty())
        throw Error(concat(folderOf(options), ": there is no scene (*.scene.json) in or below it"));
    std::cout << list;
    return 0;
}

// Lists the scenes, as there is no window to choose one in. Options that ask for work need a scene.
static int listInstead(const Options& options) {
    const bool asks = !asksForNothing(options) || options.headless || options.frames ||
                      options.context != gpu::ContextKind::automatic;
    if (!asks) return scenesCommand(options);
    throw WrongUse(options.files.empty() ? "scene is required: shoal scenes lists those that ship"
                                         : concat(options.files.front(),
                                                  ": expected a scene file, found a folder; shoal scenes ",
                                                  options.files.front(), " lists those in it"));
}

static window::WindowOptions windowOptions(const Options& options) {
    return {options.width, options.height, options.scale, options.frames, options.screenshot};
}

// Whether a molecule is too large for one lane. Such molecules take long to plan, and contexts differ in the
// sizes that they hold.
static bool hasLarge(const Scene& scene) {
    return std::any_of(scene.groups.begin(), scene.groups.end(), [](const Group& group) {
        return int(group.molecule.vertices.size()) > FusedLimits::laneVertices;
    });
}

static void checkSmall(const Scene& scene) {
    hasLarge(scene) ? checkCounts(scene) : checkPlan(scene);
}

int runCommand(const Options& options) {
    const bool window = wantsWindow(options);
    // Mistakes in the files are reported before a context is made; what the context cannot hold, once it is
    // made.
    const bool chooses = options.files.empty() || fs::is_directory(options.files.front());
    if (chooses && !window) return listInstead(options);
    std::optional<Loaded> loaded;
    if (!chooses)
        loaded = {readScene(options.files.front(), options, options.error ? checkCounts : checkSmall), {}};
    const bool plans = loaded && !options.error, large = plans && hasLarge(loaded->scene);
    if (plans && !large) planScene(*loaded);
    gpu::ContextOptions wanted = hiddenContext(options);
    wanted.preferWindow = window;
    gpu::Context context(wanted);
    if (large) {
        checkVertices(loaded->scene, options.path, limitsOf(context.info()));
        planScene(*loaded);
    }
    if (options.error && loaded) std::cerr << oneLine(calibrated(options, context, *loaded)) << "\n";
    if (context.info().kind == gpu::ContextKind::window) {
        const std::string folder = chooses ? folderOf(options) : modelFolder();
        window::runViewer({windowOptions(options), options, folder, options.editsScene}, context,
                          std::move(loaded));
        return 0;
    }
    if (!loaded) return listInstead(options);
    loaded->plan.frames = options.frames.value_or(headlessFrames);
    HeadlessRun run(options, context, std::move(*loaded));
    const FinishesOnSignal finishes;
    run.go();
    return run.tell();
}

// A scene to begin with: leaves that drop onto the ground.
static std::string firstScene(const fs::path& file) {
    const auto text = [](const std::string& words) { return writeJsonLine(JsonValue::makeString(words)); };
    return concat(R"({
  "format": "shoal-scene-1",
  "name": )",
                  text(file.stem().stem().string()), R"(,
  "gravity": [0, -9.81, 0],
  "colliders": [
    {"type": "plane"}
  ],
  "groups": [
    {
      "name": "leaves",
      "molecule": "leaf",
      "count": 100,
      "place": {"on": "volume", "box": {"low": [-1.5, 0.5, -1], "high": [1.5, 2.5, 1]}, "turn": "any"},
      "held": false,
      "drag": {"normal": 6, "tangent": 0.6}
    }
  ],
  "camera": {"eye": [0.5, 1.6, 5], "target": [0, 0.9, 0]}
}
)");
}

// A scene is edited while it runs, in the viewer's panel.
static int editScene(const Options& options) {
    const std::string& file = options.files.front();
    if (!options.editShape.empty())
        throw WrongUse(concat(file, ": --shape is for a molecule, and this is a scene"));
    Options run = options;
    run.context = gpu::ContextKind::window;
    run.editsScene = true;
    const std::string begun = fs::exists(file) ? std::string() : firstScene(file);
    if (!begun.empty()) writeFile(file, begun);
    try {
        return runCommand(run);
    } catch (const std::exception&) {
        if (!begun.empty() && readFile(file) == begun) fs::remove(file);  // there is no window, say
        throw;
    }
}

int editCommand(const Options& options) {
    if (options.files.front().ends_with(".scene.json")) return editScene(options);
    window::runEditor(options.files.front(), options.editShape, windowOptions(options));
    return 0;
}

}  // namespace shoal::app
