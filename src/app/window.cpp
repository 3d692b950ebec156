// The window: a scene that runs, a camera to move, and the panels; or a list of scenes to choose from.
#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "app/checkpoints.h"
#include "app/data_paths.h"
#include "app/interface.h"
#include "app/keys.h"
#include "app/notices.h"
#include "app/open_scene.h"
#include "app/run.h"
#include "app/scene_list.h"
#include "core/cache_folder.h"
#include "core/image.h"
#include "gpu/gl.h"

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
          keys_(window_),
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
        saveIfAsked(true);
        if (open_->running.unsaved())
            std::cerr << "shoal: warning: what was changed in the window was not saved in "
                      << open_->running.scene.file << "\n";
    }

  private:
    // Not before the user has said what becomes of what is not saved.
    bool closes() {
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
            if (open_->reload.update(open_->running, glfwGetTime())) open_->follow();
            drawScene();
        } else {
            gpu::Framebuffer::bindDefault(width_, height_);
            glClearColor(0.1f, 0.13f, 0.12f, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        interface_.begin();
        wish_ = Wish();
        drawInterface();
        interface_.end();

        ++shown_;
        const bool last = options_.frames && shown_ >= *options_.frames;
        if (last && !options_.screenshot.empty()) saveScreenshot(options_.screenshot);
        glfwSwapBuffers(window_);
        obey();
        return !last;
    }

    void drawScene() {
        OpenScene& open = *open_;
        const gpu::Traffic before = context_.traffic();
        holdForces();
        if (!open.controls.paused || steps_) {
            Simulation& simulation = open.simulation();
            open.controls.lead(simulation.parameters, simulation.plan(), simulation.parameters.frameTime);
            advance();
        }
        steps_ = false;
        Renderer& renderer = open.running.renderer();
        if (width_ != renderer.width() || height_ != renderer.height()) renderer.resize(width_, height_);
        View view = open.camera.view();
        view.time = open.simulation().time();
        try {
            renderer.draw(open.simulation().state(), view);
        } catch (const Error& error) {  // a program is made when it is needed first
            message_ = error.what();
        }
        renderer.present(width_, height_);
        lastFrame_ = context_.traffic() - before;
    }

    void drawInterface() {
        if (open_) {
            Simulation& simulation = open_->simulation();
            wish_.panel = open_->panel.draw(open_->controls, simulation, open_->running.renderer(),
                                            frameSeconds_, lastFrame_);
            drawScenePanel();
            moveCamera();
            drawNotices();
        }
        if (!opening_.empty()) {
            drawOpening(opening_);
        } else if (chooser_.open) {
            wish_.open = chooser_.draw(!open_, open_ ? std::string() : message_);
        }
        pressKeys();
    }

    // What runs away stands still, to be looked at and restarted.
    void advance() {
        try {
            open_->simulation().frame();
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
        message_ = message;
        std::cerr << "shoal: warning: " << message_ << "\n";
    }

    // --save-frames as the run passes them, else once at the end.
    void saveIfAsked(bool end) {
        const Options& options = open_->options;
        const Simulation& simulation = open_->simulation();
        const bool now =
            options.saveFrames.empty() ? end : !end && asksFor(options.saveFrames, simulation.frames(), -1);
        if (options.save.empty() || !now) return;
        const std::string file = numbered(options.save, simulation.frames(), options.saveFrames.size() > 1);
        saveState(file, simulation);
        std::cout << "saved: " << file << "\n";
    }

    // ---- What was asked for

    // What needs another simulation or may fail; what cannot be had is said, and what ran runs on.
    template <typename Work>
    void change(const Work& work) {
        try {
            work();
            message_.clear();
        } catch (const Error& error) {
            message_ = error.what();
        }
        open_->follow();
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
            break;
        case Panel::Action::resetCamera:
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
        }
        if (wish_.scene == ScenePanel::Action::save) saveScene();
        if (wish_.scene == ScenePanel::Action::revert) change([&] { running.revert(); });
        if (wish_.scene == ScenePanel::Action::rebuild) change([&] { running.edit(); });
    }

    // ---- Opening

    void listScenes() {
        chooser_.folder = !options_.files.empty() && std::filesystem::is_directory(options_.files.front())
                              ? options_.files.front()
                              : modelFolder();
        chooser_.scenes = scenesBelow(chooser_.folder);
        chooser_.open = true;
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
        Options options = optionsOf(std::exchange(opening_, {}));
        try {
            Loaded loaded = load(options);
            auto next = std::make_unique<OpenScene>(std::move(options), context_, cache_, std::move(loaded),
                                                    width_, height_);
            open_ = std::move(next);
            message_.clear();
            chooser_.open = discards_ = shownUnsaved_ = false;
            std::cout << "opened: " << open_->running.scene.file << std::endl;
            glfwSetWindowTitle(window_, title().c_str());
        } catch (const Error& error) {
            message_ = error.what();
            std::cerr << "shoal: warning: not opened: " << message_ << std::endl;
            chooser_.open = true;
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
        return "Shoal - " + std::filesystem::path(open_->running.scene.file).filename().string();
    }

    // ---- What is edited and saved

    void drawScenePanel() {
        OpenScene& open = *open_;
        const bool changed = open.running.unsaved();
        if (!open.scenePanel.empty()) {
            wish_.scene =
                open.scenePanel.draw(open.running.scene, open.simulation(), open.running.renderer(), changed);
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
            message_ = concat("Not saved: ", error.what());
            std::cerr << "shoal: warning: not saved: " << error.what() << "\n";
            return false;
        }
        open_->reload.accept(open_->running.scene.file);
        message_.clear();
        open_->scenePanel.say(", saved");
        return true;
    }

    void drawNotices() {
        HotReload& reload = open_->reload;
        const float right = open_->scenePanel.empty() ? points(12) : points(392);
        const bool closed = showNotices(reload.problem(), message_, points(328), right);
        if (closed) message_.clear();
        if (reload.conflicts().empty() || asked_) return;
        const std::optional<Prefer> answer = askWhoWins(reload.conflicts());
        if (answer && reload.settle(open_->running, *answer)) open_->follow();
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
    }

    void pressKeys() {
        keys_.look(!ImGui::GetIO().WantCaptureKeyboard);
        if (keys_.pressed(GLFW_KEY_O) && !asked_ && opening_.empty()) listScenes();
        if (keys_.pressed(GLFW_KEY_ESCAPE)) escape();
        if (!open_) return;
        Controls& controls = open_->controls;
        if (keys_.pressed(GLFW_KEY_SPACE)) controls.paused = !controls.paused;
        if (keys_.pressed(GLFW_KEY_S) && keys_.control() && !open_->scenePanel.empty())
            wish_.scene = ScenePanel::Action::save;
        if (keys_.pressed(GLFW_KEY_R)) wish_.panel = Panel::Action::restart;
        if (keys_.pressed(GLFW_KEY_C)) wish_.panel = Panel::Action::resetCamera;
        if (keys_.pressed(GLFW_KEY_PERIOD)) {
            controls.paused = true;
            wish_.panel = Panel::Action::step;
        }
    }

    // What lies on top goes first, the window last.
    void escape() {
        if (chooser_.open && open_)
            chooser_.open = false;
        else
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
    }

    // The window as the user sees it, panel and all.
    void saveScreenshot(const std::string& file) {
        Image image{width_, height_, 4, std::vector<uint8_t>(size_t(width_) * size_t(height_) * 4)};
        const size_t row = size_t(width_) * 4;
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        std::vector<uint8_t> bottomUp(image.pixels.size());
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, bottomUp.data());
        for (size_t y = 0; y < size_t(height_); ++y)
            std::copy_n(bottomUp.begin() + std::ptrdiff_t((size_t(height_) - 1 - y) * row), row,
                        image.pixels.begin() + std::ptrdiff_t(y * row));
        for (size_t i = 3; i < image.pixels.size(); i += 4)
            image.pixels[i] = 255;
        writePng(file, image);
        std::cout << "screenshot: " << file << "\n";
    }

    const Options& options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    Interface interface_;
    Keys keys_;
    gpu::ProgramCache cache_;
    SceneChooser chooser_;
    std::unique_ptr<OpenScene> open_;  // null: nothing was chosen yet
    std::string opening_;              // a scene's file
    Wish wish_;
    std::optional<Wish> asked_;  // to close or open, while something is not saved
    bool saidOpening_ = false, discards_ = false, shownUnsaved_ = false, steps_ = false;
    gpu::Traffic lastFrame_;
    std::string message_;
    double frameSeconds_ = 0;  // s, wall clock, smoothed
    int width_ = 0, height_ = 0, shown_ = 0;
};

}  // namespace

int runWindow(const Options& options, gpu::Context& context, std::optional<Loaded> loaded) {
    WindowRun(options, context, std::move(loaded)).go();
    return 0;
}

}  // namespace shoal::app
