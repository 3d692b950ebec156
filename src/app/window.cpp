// The window: a scene that runs, a camera to move, and the panels; or a list of scenes to choose from.
#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>
#include <utility>

#include "app/checkpoints.h"
#include "app/data_paths.h"
#include "app/help.h"
#include "app/interface.h"
#include "app/method_error.h"
#include "app/molecule_window.h"
#include "app/notices.h"
#include "app/open_scene.h"
#include "app/recorder.h"
#include "app/run.h"
#include "app/scene_list.h"
#include "app/screenshot.h"
#include "app/signals.h"
#include "core/cache_folder.h"
#include "core/image.h"
#include "core/many.h"
#include "core/printable.h"
#include "gpu/gl.h"
#include "scene/json/scene_files.h"

namespace shoal::app {

namespace {

// What the user asked for in a frame, done at its end.
struct Wish {
    Panel::Action panel = Panel::Action::none;
    ScenePanel::Action scene = ScenePanel::Action::none;
    std::string open;  // a scene's file
    bool close = false;
};

class WindowRun {
  public:
    WindowRun(const Options& options, gpu::Context& context, std::optional<Loaded> loaded)
        : options_(options),
          context_(context),
          window_(context.window()),
          interface_(window_, options.scale),
          cache_(context, cacheFolder()) {
        glfwSwapInterval(1);
        glfwGetFramebufferSize(window_, &width_, &height_);
        if (loaded) {
            open_ =
                std::make_unique<OpenScene>(options, context, cache_, std::move(*loaded), width_, height_);
            return;
        }
        listScenes();
    }

    void go() {
        const FinishesOnSignal finishes;
        auto last = std::chrono::steady_clock::now();
        while (!closes()) {
            glfwPollEvents();
            const auto now = std::chrono::steady_clock::now();
            const double seconds = std::chrono::duration<double>(now - last).count();
            last = now;
            // the first intervals hold start-up, not frames
            if (shown_ > 1) frameSeconds_ += (seconds - frameSeconds_) * (shown_ == 2 ? 1 : 0.1);
            if (!showFrame()) break;
        }
        if (!open_) return;
        if (recorder_.records()) toggleRecording();
        saveIfAsked(true);
        if (open_->running.unsaved())
            std::cerr << "shoal: warning: what was changed in the window was not saved in "
                      << printable(open_->running.scene.file) << "\n";
    }

  private:
    // Not before the user has said what becomes of what is not saved.
    bool closes() {
        if (signalThatAsked()) return true;
        if (!glfwWindowShouldClose(window_)) return false;
        if (!open_ || discards_ || !open_->running.unsaved()) return true;
        asked_ = Wish();
        asked_->close = true;
        glfwSetWindowShouldClose(window_, GLFW_FALSE);
        return false;
    }

    // One frame of simulation and picture; false after the last of --frames.
    bool showFrame() {
        glfwGetFramebufferSize(window_, &width_, &height_);
        if (width_ < 1 || height_ < 1) {  // minimised: time stands still
            glfwWaitEventsTimeout(0.1);
            return true;
        }
        if (open_) {
            if (open_->reload.update(open_->running, glfwGetTime())) takeReloaded();
            drawScene();
        } else {
            gpu::Framebuffer::bindDefault(width_, height_);
            glClearColor(0.1f, 0.13f, 0.12f, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        if (!refused_.changed(glfwGetTime()).empty() && chooser_.open) listScenes();
        interface_.begin();
        wish_ = Wish();
        drawInterface();
        interface_.end();

        ++shown_;
        const bool last = options_.frames && shown_ >= *options_.frames;
        const bool closing = last || glfwWindowShouldClose(window_);
        if (closing && !options_.screenshot.empty()) saveScreenshot(options_.screenshot, width_, height_);
        glfwSwapBuffers(window_);
        obey();
        return !last;
    }

    void drawScene() {
        OpenScene& open = *open_;
        const gpu::Traffic before = context_.traffic();
        holdForces();
        const bool steps = !open.controls.paused || steps_;
        if (steps) {
            Simulation& simulation = open.simulation();
            open.controls.lead(simulation.parameters, simulation.plan(), simulation.parameters.frameTime);
            advance();
        }
        steps_ = false;
        Renderer& renderer = open.running.renderer();
        if (width_ != renderer.width() || height_ != renderer.height()) renderer.resize(width_, height_);
        open.readPicked();
        try {
            open.drawPicture(1.5 * interface_.pixelsPerPoint());
            troubles_.end("picture");
        } catch (const Error& error) {  // a program is made when it is needed first
            complain("picture", error.what());
        }
        // and its files are watched from then on
        const size_t files = context_.shaderFiles().size();
        if (std::exchange(shaderFiles_, files) != files) open.reload.follow(open.running, false);
        renderer.present(width_, height_);
        lastFrame_ = context_.traffic() - before;
        if (recorder_.records() && steps) attempt("recording", [&] { recorder_.add(renderer.capture()); });
    }

    void drawInterface() {
        if (open_) drawOpenScene();
        if (!opening_.empty()) {
            drawOpening(opening_);
        } else if (chooser_.open) {
            wish_.open = chooser_.draw(!open_, open_ ? std::string() : troubles_.text());
        }
        if (!chooser_.open) troubles_.end("opening");
        if (helps_) helps_ = showHelp("Keys", windowHelp);
        pressKeys();
    }

    void drawOpenScene() {
        OpenScene& open = *open_;
        if (!hidden_) {
            wish_.panel = open.panel.draw(open.controls, open.simulation(), open.running.renderer(),
                                          *open.explanations, frameSeconds_, lastFrame_);
            drawPicked();
        }
        drawScenePanel();
        moveCamera();
        drawNotices();
    }

    void drawPicked() {
        OpenScene& open = *open_;
        if (!open.explanations->picked || !open.numbers) return;
        const double aspect = double(width_) / height_;
        if (const auto at = onScreen(open.view(), open.numbers->middle, aspect))
            markMolecule(*at, points(14));
        const PickedMolecule& picked = *open.explanations->picked;
        const Group& group = open.running.scene.groups[open.simulation().plan().groups[picked.group].index];
        const MoleculeAction action =
            showMolecule(picked, group.name, group.molecule, *open.numbers, open.follows, points(328));
        if (action == MoleculeAction::follow) open.follows = !open.follows;
        if (action == MoleculeAction::close) open.forget();
    }

    // What runs away stands still, to be looked at and restarted.
    void advance() {
        try {
            open_->simulation().frame();
            troubles_.end("run");
        } catch (const Runaway& runaway) {
            pauseWith(concat(runaway.what(), ". ",
                             saveForInspection(open_->options, open_->simulation(), runaway)));
            return;
        } catch (const Error& error) {
            pauseWith(error.what());
            return;
        }
        saveIfAsked(false);
    }

    void pauseWith(const std::string& message) {
        open_->controls.paused = true;
        complain("run", message);
    }

    void complain(const std::string& cause, const std::string& words) {
        if (troubles_.begin(cause, words)) std::cerr << "shoal: warning: " << words << std::endl;
    }

    // --save-frames as the run passes them, else once at the end.
    void saveIfAsked(bool end) {
        const Options& options = open_->options;
        const Simulation& simulation = open_->simulation();
        const bool now =
            options.saveFrames.empty() ? end : !end && contains(options.saveFrames, simulation.frames());
        if (options.save.empty() || !now) return;
        const auto last = std::max_element(options.saveFrames.begin(), options.saveFrames.end());
        const std::string file = numbered(options.save, simulation.frames(), options.saveFrames.size() > 1,
                                          last == options.saveFrames.end() ? 0 : *last);
        saveState(file, simulation);
        std::cout << "saved: " << printable(file) << "\n";
    }

    // ---- What was asked for

    // What needs another simulation or may fail; what cannot be had is said, and what ran runs on.
    template <typename Work>
    void change(const Work& work) {
        attempt("change", work);
        open_->follow();
    }

    template <typename Work>
    void attempt(const std::string& cause, const Work& work) {
        try {
            work();
            troubles_.end(cause);
        } catch (const Error& error) {
            troubles_.end(cause);  // each attempt is told
            complain(cause, error.what());
        }
    }

    // What could not be had before was of the files as they were.
    void takeReloaded() {
        open_->follow();
        for (const char* cause : {"change", "run"})
            troubles_.end(cause);
    }

    void obey() {
        if (!opening_.empty()) return openNow();
        if (open_) obeyPanels();
        if (!wish_.open.empty()) askToOpen(wish_.open);
    }

    void obeyPanels() {
        RunningScene& running = open_->running;
        switch (wish_.panel) {
        case Panel::Action::none:
            break;
        case Panel::Action::step:
            steps_ = true;
            break;
        case Panel::Action::restart:
            running.simulation().restart();
            troubles_.end("run");
            break;
        case Panel::Action::resetCamera:
            open_->follows = false;
            open_->camera.reset();
            break;
        case Panel::Action::rebuild:
            change([&] {
                open_->panel.apply(running.choices);
                running.choose();
            });
            break;
        case Panel::Action::switchPath:
            change([&] { running.switchPath(open_->panel.path); });
            break;
        case Panel::Action::scenes:
            listScenes();
            break;
        case Panel::Action::measure:
            measureMethod();
            break;
        }
        if (wish_.scene == ScenePanel::Action::save) saveScene();
        if (wish_.scene == ScenePanel::Action::revert) change([&] { running.revert(); });
        if (wish_.scene == ScenePanel::Action::rebuild) change([&] { running.edit(); });
    }

    void measureMethod() {
        measure::AccuracyDevice device;
        device.context = &context_;
        device.shaderRoot = shaderRoot();
        device.cache = &cache_;
        device.cores = int(std::max(1u, std::thread::hardware_concurrency()));
        device.path = open_->simulation().path().path;
        open_->panel.error = methodError(open_->running.scene, open_->simulation(), device);
        std::cout << open_->panel.error << std::endl;
    }

    // ---- Pictures and videos, without the panels

    std::string stem() const { return sceneStem(open_->running.scene.file); }

    void tell(const std::string& line) {
        status_.say(line);
        std::cout << printable(line) << std::endl;
    }

    void takePicture() {
        attempt("capture", [&] {
            const std::string file = freeName(stem(), ".png");
            writePng(file, open_->running.renderer().capture());
            tell("picture: " + file);
        });
    }

    void toggleRecording() {
        attempt("recording", [&] {
            if (!recorder_.records()) return recorder_.start(stem(), open_->running.scene.frameRate);
            recorder_.stop();
            tell(concat("recorded: ", recorder_.target(), ", ", many(recorder_.frames(), "frame", "frames")));
        });
    }

    // ---- Opening

    void listScenes() {
        chooser_.folder = !options_.files.empty() && std::filesystem::is_directory(options_.files.front())
                              ? options_.files.front()
                              : modelFolder();
        chooser_.scenes = scenesBelow(chooser_.folder);
        chooser_.open = true;
        troubles_.end("opening");
    }

    void askToOpen(const std::string& file) {
        if (open_ && open_->running.unsaved()) {
            asked_ = Wish();
            asked_->open = file;
        } else {
            opening_ = file;
        }
    }

    // After a frame that says so, because it may take a while.
    void openNow() {
        if (std::exchange(saidOpening_, !saidOpening_) == false) return;
        if (recorder_.records()) toggleRecording();
        const std::string file = std::exchange(opening_, {});
        Options options = optionsOf(file);
        try {
            Loaded loaded = load(options);
            auto next = std::make_unique<OpenScene>(std::move(options), context_, cache_, std::move(loaded),
                                                    width_, height_);
            open_ = std::move(next);
            troubles_.clear();
            chooser_.open = discards_ = shownUnsaved_ = false;
            std::cout << "opened: " << printable(open_->running.scene.file) << std::endl;
            glfwSetWindowTitle(window_, title().c_str());
        } catch (const Error& error) {
            troubles_.begin("opening", error.what());
            std::cerr << "shoal: warning: not opened: " << error.what() << std::endl;
            chooser_.open = true;
            refused_.watch({});
            refused_.watch(filesOf(file));
        }
    }

    // What was asked of the first scene does not bind the others.
    Options optionsOf(const std::string& file) const {
        Options out;
        out.files = {file};
        out.path = options_.path;
        out.lanes = options_.lanes;
        out.inPlace = options_.inPlace;
        return out;
    }

    std::string title() const {
        return "Shoal - " + printable(std::filesystem::path(open_->running.scene.file).filename().string());
    }

    // ---- What is edited and saved

    void drawScenePanel() {
        OpenScene& open = *open_;
        const bool changed = open.running.unsaved();
        if (!changed) troubles_.end("saving");
        if (!hidden_) {
            wish_.scene = open.scenePanel.draw(open.running, changed);
            if (open.scenePanel.changed() && !open.scenePanel.pending()) open.running.accept();
        }
        if (std::exchange(shownUnsaved_, changed) != changed)
            glfwSetWindowTitle(window_, (title() + (changed ? " *" : "")).c_str());
        if (asked_) askAboutUnsaved();
    }

    void askAboutUnsaved() {
        const Wish wanted = *asked_;
        const Answer answer =
            askBeforeLeaving(open_->running.scene.file, wanted.close ? "close" : "open another scene");
        if (answer == Answer::none) return;
        asked_.reset();
        if (answer == Answer::stay || (answer == Answer::save && !saveScene())) return;
        discards_ = answer == Answer::discard;
        if (wanted.close) glfwSetWindowShouldClose(window_, GLFW_TRUE);
        if (!wanted.close) opening_ = wanted.open;
    }

    bool saveScene() {
        try {
            open_->running.save();
        } catch (const Error& error) {
            troubles_.begin("saving", concat("Not saved: ", error.what()));
            std::cerr << "shoal: warning: not saved: " << error.what() << "\n";
            return false;
        }
        open_->reload.accept(open_->running.scene.file);
        troubles_.end("saving");
        open_->scenePanel.say(", saved");
        return true;
    }

    void drawNotices() {
        HotReload& reload = open_->reload;
        status_.draw(recorder_.records() ? concat("Recording ", recorder_.target(), ", ",
                                                  many(recorder_.frames(), "frame", "frames"), "; V stops")
                                         : std::string());
        const bool closed = showNotices(reload.problem(), troubles_.text(), points(hidden_ ? 12 : 328),
                                        points(hidden_ ? 12 : 392));
        if (closed) troubles_.clear();
        if (asked_) return;
        const std::optional<Prefer> answer = askWhoWins(reload.conflicts());
        if (answer && reload.settle(open_->running, *answer)) takeReloaded();
    }

    // ---- The mouse and the keys

    // Forces of the mouse act while Shift and the left button are held: where the pointer is, at the distance
    // of what the camera looks at.
    bool holdsForces() const {
        const ImGuiIO& io = ImGui::GetIO();
        const auto& forces = open_->simulation().plan().forces;
        return !io.WantCaptureMouse && io.KeyShift && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
               std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.mouse; });
    }

    void holdForces() {
        const ImGuiIO& io = ImGui::GetIO();
        const bool held = shown_ > 0 && holdsForces();
        const std::vector<Force>& forces = open_->simulation().plan().forces;
        for (size_t i = 0; i < forces.size(); ++i) {
            if (!forces[i].mouse) continue;
            ForceControl& control = open_->simulation().parameters.forces[i];
            control.on = held;
            if (!held) continue;
            const glm::dvec2 place(io.MousePos.x / io.DisplaySize.x, io.MousePos.y / io.DisplaySize.y);
            control.position = onTargetPlane(open_->camera.view(), place, double(width_) / height_);
        }
    }

    void moveCamera() {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse || holdsForces()) return;
        OrbitCamera& camera = open_->camera;
        const double dx = double(io.MouseDelta.x / io.DisplaySize.y),
                     dy = double(io.MouseDelta.y / io.DisplaySize.y);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) camera.turn(dx, dy);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
            camera.pan(dx, dy);
        if (io.MouseWheel != 0) camera.zoom(double(io.MouseWheel));
        pickOnClick();
    }

    // A click, and not a drag that turns the camera.
    void pickOnClick() {
        const ImGuiIO& io = ImGui::GetIO();
        constexpr float still = 3;  // points
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) pressedAt_ = io.MousePos;
        if (!ImGui::IsMouseReleased(ImGuiMouseButton_Left) || io.KeyShift || !pressedAt_) return;
        const ImVec2 from = *std::exchange(pressedAt_, {});
        if (std::hypot(io.MousePos.x - from.x, io.MousePos.y - from.y) > points(still)) return;
        open_->pick({io.MousePos.x / io.DisplaySize.x, io.MousePos.y / io.DisplaySize.y},
                    double(width_) / height_, height_);
        if (const auto& picked = open_->explanations->picked)
            std::cout << "picked: " << printable(open_->simulation().plan().groups[picked->group].name) << " "
                      << picked->molecule << std::endl;
    }

    void pressKeys() {
        keys_.look(!ImGui::GetIO().WantCaptureKeyboard);
        if (keys_.pressed(GLFW_KEY_F1) || keys_.pressed(GLFW_KEY_SLASH)) helps_ = !helps_;
        if (keys_.pressed(GLFW_KEY_O) && !asked_ && opening_.empty()) listScenes();
        if (keys_.pressed(GLFW_KEY_ESCAPE)) escape();
        if (open_) pressSceneKeys();
    }

    void pressSceneKeys() {
        Controls& controls = open_->controls;
        ExplanationSettings& settings = open_->explanations->settings;
        if (keys_.pressed(GLFW_KEY_SPACE)) controls.paused = !controls.paused;
        if (keys_.pressed(GLFW_KEY_S) && keys_.control()) wish_.scene = ScenePanel::Action::save;
        if (keys_.pressed(GLFW_KEY_R)) wish_.panel = Panel::Action::restart;
        if (keys_.pressed(GLFW_KEY_C) || keys_.pressed(GLFW_KEY_4)) wish_.panel = Panel::Action::resetCamera;
        if (keys_.pressed(GLFW_KEY_PERIOD)) {
            controls.paused = true;
            wish_.panel = Panel::Action::step;
        }
        if (keys_.pressed(GLFW_KEY_X)) settings.springs = !settings.springs;
        if (keys_.pressed(GLFW_KEY_F)) settings.field = !settings.field;
        if (keys_.pressed(GLFW_KEY_H)) hidden_ = !hidden_;
        if (keys_.pressed(GLFW_KEY_P)) takePicture();
        if (keys_.pressed(GLFW_KEY_V)) toggleRecording();
        constexpr double quarter = 1.5707963267948966;  // rad
        if (keys_.pressed(GLFW_KEY_1)) open_->camera.lookFrom(0, 0);
        if (keys_.pressed(GLFW_KEY_2)) open_->camera.lookFrom(quarter, 0);
        if (keys_.pressed(GLFW_KEY_3)) open_->camera.lookFrom(0, quarter);
        if (keys_.pressed(GLFW_KEY_5) && open_->explanations->picked) open_->follows = !open_->follows;
    }

    // What lies on top goes first, the window last.
    void escape() {
        if (helps_)
            helps_ = false;
        else if (chooser_.open && open_)
            chooser_.open = false;
        else if (open_ && open_->explanations->picked)
            open_->forget();
        else
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
    }

    const Options& options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    Interface interface_;
    Input& keys_{interface_.input()};
    gpu::ProgramCache cache_;
    SceneChooser chooser_;
    std::unique_ptr<OpenScene> open_;  // null: nothing was chosen yet
    std::string opening_;              // a scene's file
    Wish wish_;
    std::optional<Wish> asked_;  // to close or open, while something is not saved
    bool saidOpening_ = false, discards_ = false, shownUnsaved_ = false, steps_ = false;
    size_t shaderFiles_ = 0;
    gpu::Traffic lastFrame_;
    Recorder recorder_;
    Troubles troubles_;
    FileWatch refused_;  // the scene that was not opened
    StatusLine status_;
    std::optional<ImVec2> pressedAt_;      // where the left button went down on the picture
    bool helps_ = false, hidden_ = false;  // the keys are shown; the panels are not
    double frameSeconds_ = 0;              // s, wall clock, smoothed
    int width_ = 0, height_ = 0, shown_ = 0;
};

}  // namespace

int runWindow(const Options& options, gpu::Context& context, std::optional<Loaded> loaded) {
    WindowRun(options, context, std::move(loaded)).go();
    return 0;
}

}  // namespace shoal::app
