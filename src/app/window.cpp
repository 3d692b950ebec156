// The window: a scene that runs, a camera to move, and the panel.
#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <utility>

#include "app/checkpoints.h"
#include "app/data_paths.h"
#include "app/interface.h"
#include "app/orbit_camera.h"
#include "app/panel.h"
#include "app/run.h"
#include "app/scene_panel.h"
#include "core/cache_folder.h"
#include "core/image.h"
#include "gpu/gl.h"
#include "molecule/molecule_file.h"
#include "render/renderer.h"
#include "scene/scene_saver.h"
#include "simulate/carry_over.h"
#include "simulate/simulation.h"

namespace shoal::app {

namespace {

std::vector<std::string> shippedMolecules() {
    const std::filesystem::path folder = std::filesystem::path(shaderRoot()).parent_path() / "molecules";
    std::vector<std::string> files;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == ".json" && name.find(".schema.") == std::string::npos)
            files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class WindowRun {
  public:
    WindowRun(const Options& options, gpu::Context& context, Loaded loaded)
        : options_(options),
          context_(context),
          window_(context.window()),
          original_(loaded.scene),
          scene_(std::move(loaded.scene)),
          controls_(loaded.plan),
          panel_(scene_, shippedMolecules()),
          scenePanel_(scene_),
          running_(scene_.groups),
          camera_(View::of(scene_.camera)),
          interface_(window_, options.scale),
          cache_(context, cacheFolder()),
          path_(options.path) {
        glfwSwapInterval(1);
        glfwGetFramebufferSize(window_, &width_, &height_);
        build(std::move(loaded.plan));
        checkSave(options);
        if (options.resume.empty()) return;
        resume(options, *simulation_);
        controls_.follow(simulation_->parameters);
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
        saveIfAsked(true);
        if (unsaved())
            std::cerr << "shoal: warning: what was changed in the window was not saved in " << scene_.file
                      << "\n";
    }

  private:
    // Not before the user has said what becomes of what is not saved.
    bool closes() {
        if (!glfwWindowShouldClose(window_)) return false;
        asksToClose_ = unsaved() && !discards_;
        if (asksToClose_) glfwSetWindowShouldClose(window_, GLFW_FALSE);
        return !asksToClose_;
    }

    void build(Plan plan) {
        simulation_.reset();
        renderer_.reset();
        SimulationOptions wanted;
        wanted.timing = gpu::PassTimers::suitedTo(context_.info());
        wanted.path = path_;
        // what was asked of the fused path does not bind the other
        if (path_ != Path::pingPong) wanted.inPlace = options_.inPlace, wanted.lanes = options_.lanes;
        wanted.cache = &cache_;
        simulation_ = std::make_unique<Simulation>(context_, shaderRoot(), std::move(plan), wanted);
        tellWarnings(*simulation_, cache_);
        RenderOptions size;
        size.width = width_;
        size.height = height_;
        size.timing = wanted.timing;
        renderer_ = std::make_unique<Renderer>(context_, shaderRoot(), scene_, simulation_->plan(), size);
        controls_.lead(simulation_->parameters, simulation_->plan(), 1e3);  // as the sliders stand, at once
    }

    // The other path goes on from the same state; where it cannot, that is said and the old one stays.
    void switchPath() {
        const Path old = path_;
        const SavedState saved = simulation_->save();
        const Plan plan = simulation_->plan();
        try {
            path_ = panel_.path;
            build(plan);
            message_.clear();
        } catch (const Error& error) {
            message_ = error.what();
            path_ = old;
            build(plan);
        }
        simulation_->load(saved);
    }

    // One frame of simulation and picture; false after the last of --frames.
    bool showFrame() {
        glfwGetFramebufferSize(window_, &width_, &height_);
        if (width_ < 1 || height_ < 1) {  // minimised: time stands still
            glfwWaitEventsTimeout(0.1);
            return true;
        }
        const gpu::Traffic before = context_.traffic();
        holdForces();
        if (!controls_.paused || action_ == Panel::Action::step) {
            controls_.lead(simulation_->parameters, simulation_->plan(), simulation_->parameters.frameTime);
            advance();
        }
        if (width_ != renderer_->width() || height_ != renderer_->height())
            renderer_->resize(width_, height_);
        View view = camera_.view();
        view.time = simulation_->time();
        renderer_->draw(simulation_->state(), view);
        renderer_->present(width_, height_);
        lastFrame_ = context_.traffic() - before;

        interface_.begin();
        action_ = panel_.draw(controls_, *simulation_, *renderer_, frameSeconds_, lastFrame_);
        drawScenePanel();
        moveCamera();
        pressKeys();
        if (!message_.empty()) showMessage();
        interface_.end();

        ++shown_;
        const bool last = options_.frames && shown_ >= *options_.frames;
        if (last && !options_.screenshot.empty()) saveScreenshot();
        glfwSwapBuffers(window_);
        obey();
        return !last;
    }

    // What runs away stands still, to be looked at and restarted.
    void advance() {
        try {
            simulation_->frame();
        } catch (const Runaway& runaway) {
            controls_.paused = true;
            message_ = concat(runaway.what(), ". ", saveForInspection(options_, *simulation_, runaway));
            std::cerr << "shoal: warning: " << message_ << "\n";
            return;
        }
        saveIfAsked(false);
    }

    // --save-frames as the run passes them, else once at the end.
    void saveIfAsked(bool end) {
        const bool now = options_.saveFrames.empty()
                             ? end
                             : !end && asksFor(options_.saveFrames, simulation_->frames(), -1);
        if (options_.save.empty() || !now) return;
        const std::string file =
            numbered(options_.save, simulation_->frames(), options_.saveFrames.size() > 1);
        saveState(file, *simulation_);
        std::cout << "saved: " << file << "\n";
    }

    void obey() {
        if (action_ == Panel::Action::restart) simulation_->restart();
        if (action_ == Panel::Action::resetCamera) camera_.reset();
        if (action_ == Panel::Action::rebuild) rebuild();
        if (action_ == Panel::Action::switchPath) switchPath();
        if (sceneAction_ == ScenePanel::Action::save) saveScene();
        if (sceneAction_ == ScenePanel::Action::revert) revert();
        if (sceneAction_ == ScenePanel::Action::rebuild) rebuildEdited();
    }

    // ---- What is edited: scene_ runs, original_ is as the file, running_ was accepted last

    bool unsaved() const { return differ(original_, scene_); }

    void drawScenePanel() {
        sceneAction_ = ScenePanel::Action::none;
        if (scenePanel_.empty()) return;
        const bool changed = unsaved();
        sceneAction_ = scenePanel_.draw(scene_, *simulation_, *renderer_, changed);
        if (scenePanel_.changed() && !scenePanel_.pending()) running_ = scene_.groups;
        if (std::exchange(shownUnsaved_, changed) != changed)
            glfwSetWindowTitle(window_, (title() + (changed ? " *" : "")).c_str());
        if (!asksToClose_) return;
        const ScenePanel::Answer answer = scenePanel_.askBeforeClosing(scene_.file);
        if (answer == ScenePanel::Answer::none) return;
        asksToClose_ = false;
        discards_ = answer == ScenePanel::Answer::discard;
        const bool saved = answer == ScenePanel::Answer::save && saveScene();
        if (discards_ || saved) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    }

    std::string title() const { return "Shoal - " + std::filesystem::path(scene_.file).filename().string(); }

    bool saveScene() {
        try {
            saveEdits(original_, scene_);
        } catch (const Error& error) {
            message_ = concat("Not saved: ", error.what());
            std::cerr << "shoal: warning: not saved: " << error.what() << "\n";
            return false;
        }
        copyEdits(scene_.groups, original_.groups);
        message_.clear();
        scenePanel_.say(", saved");
        return true;
    }

    void revert() {
        copyEdits(original_.groups, scene_.groups);
        rebuildEdited();
    }

    // What the scene panel edits.
    static void copyEdits(const std::vector<Group>& from, std::vector<Group>& to) {
        for (size_t g = 0; g < from.size(); ++g) {
            to[g].life = from[g].life;
            to[g].particle = from[g].particle;
        }
    }

    Plan compileEdited() {
        for (Group& group : scene_.groups)
            if (group.particle) group.molecule = moleculeOf(*group.particle);
        scene_.solver.substeps = original_.solver.substeps;
        return compileStably();
    }

    // Goes on from where it is, where that is possible. What cannot be had is said, and what ran runs on.
    void rebuildEdited() {
        const SavedState saved = simulation_->save();
        const Plan old = simulation_->plan();
        const Parameters parameters = simulation_->parameters;
        try {
            build(compileEdited());
            message_.clear();
        } catch (const Error& error) {
            message_ = error.what();
            copyEdits(running_, scene_.groups);
            build(compileEdited());
        }
        if (const std::optional<SavedState> carried = carryOver(saved, old, simulation_->plan()))
            simulation_->load(*carried);
        simulation_->parameters = parameters;
        running_ = scene_.groups;
        scenePanel_.follow(scene_);
    }

    // Another number or kind of molecules; what cannot be had is said and the old scene runs on.
    void rebuild() {
        const Scene old = scene_;
        scene_.solver.substeps = original_.solver.substeps;
        try {
            Group& group = scene_.groups[size_t(panel_.choice.group)];
            group.count = panel_.choice.count;
            if (group.life) group.life->capacity = std::max(group.life->capacity, group.count);
            group.molecule = panel_.choice.molecule < 0
                                 ? original_.groups[size_t(panel_.choice.group)].molecule
                                 : readMolecule(panel_.molecules[size_t(panel_.choice.molecule)]);
            build(compileStably());
            message_.clear();
            shownMolecule_ = panel_.choice.molecule;
            running_ = scene_.groups;
            scenePanel_.follow(scene_);
        } catch (const Error& error) {
            message_ = error.what();
            scene_ = old;
            panel_.choice.count = old.groups[size_t(panel_.choice.group)].count;
            panel_.choice.molecule = shownMolecule_;
            build(compile(scene_));
        }
    }

    // A stiffer molecule takes more substeps instead of being refused.
    Plan compileStably() {
        for (int tries = 0; tries < 12; ++tries) {
            try {
                return compile(scene_);
            } catch (const Error&) {
                if (scene_.solver.substeps >= 256) throw;
                scene_.solver.substeps *= 2;
            }
        }
        return compile(scene_);
    }

    void showMessage() {
        ImGui::SetNextWindowPos(ImVec2(points(330), points(12)), ImGuiCond_Always);
        const float panels = points(scenePanel_.empty() ? 350 : 730);  // to its left and right
        ImGui::SetNextWindowSize(ImVec2(std::max(points(200), ImGui::GetIO().DisplaySize.x - panels), 0));
        ImGui::Begin("Message", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize);
        ImGui::TextWrapped("%s", message_.c_str());
        if (ImGui::Button("Close")) message_.clear();
        ImGui::End();
    }

    // Forces of the mouse act while Shift and the left button are held: where the pointer is, at the distance
    // of what the camera looks at.
    bool holdsForces() const {
        const ImGuiIO& io = ImGui::GetIO();
        const auto& forces = simulation_->plan().forces;
        return !io.WantCaptureMouse && io.KeyShift && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
               std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.mouse; });
    }

    void holdForces() {
        const ImGuiIO& io = ImGui::GetIO();
        const bool held = shown_ > 0 && holdsForces();
        const std::vector<Force>& forces = simulation_->plan().forces;
        for (size_t i = 0; i < forces.size(); ++i) {
            if (!forces[i].mouse) continue;
            ForceControl& control = simulation_->parameters.forces[i];
            control.on = held;
            if (!held) continue;
            const glm::dvec2 place(io.MousePos.x / io.DisplaySize.x, io.MousePos.y / io.DisplaySize.y);
            control.position = onTargetPlane(camera_.view(), place, double(width_) / height_);
        }
    }

    void moveCamera() {
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantCaptureMouse || holdsForces()) return;
        const double dx = double(io.MouseDelta.x / io.DisplaySize.y),
                     dy = double(io.MouseDelta.y / io.DisplaySize.y);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) camera_.turn(dx, dy);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
            camera_.pan(dx, dy);
        if (io.MouseWheel != 0) camera_.zoom(double(io.MouseWheel));
    }

    void pressKeys() {
        if (ImGui::GetIO().WantCaptureKeyboard) return;
        // by the window, not by ImGui, whose key codes changed their type in 1.89
        const auto pressed = [this](int key) {
            const bool down = glfwGetKey(window_, key) == GLFW_PRESS;
            return down && !std::exchange(keysDown_[key], down) ? true : (keysDown_[key] = down, false);
        };
        if (pressed(GLFW_KEY_SPACE)) controls_.paused = !controls_.paused;
        const bool control = glfwGetKey(window_, GLFW_KEY_LEFT_CONTROL) == GLFW_PRESS ||
                             glfwGetKey(window_, GLFW_KEY_RIGHT_CONTROL) == GLFW_PRESS;
        if (pressed(GLFW_KEY_S) && control && !scenePanel_.empty()) sceneAction_ = ScenePanel::Action::save;
        if (pressed(GLFW_KEY_R)) action_ = Panel::Action::restart;
        if (pressed(GLFW_KEY_C)) action_ = Panel::Action::resetCamera;
        if (pressed(GLFW_KEY_ESCAPE)) glfwSetWindowShouldClose(window_, GLFW_TRUE);
        if (pressed(GLFW_KEY_PERIOD)) {
            controls_.paused = true;
            action_ = Panel::Action::step;
        }
    }

    // The window as the user sees it, panel and all.
    void saveScreenshot() {
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
        writePng(options_.screenshot, image);
        std::cout << "screenshot: " << options_.screenshot << "\n";
    }

    const Options& options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    Scene original_, scene_;
    Controls controls_;
    Panel panel_;
    ScenePanel scenePanel_;
    std::vector<Group> running_;  // of scene_, as they run
    OrbitCamera camera_;
    Interface interface_;
    gpu::ProgramCache cache_;
    Path path_;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
    Panel::Action action_ = Panel::Action::none;
    ScenePanel::Action sceneAction_ = ScenePanel::Action::none;
    bool asksToClose_ = false, discards_ = false, shownUnsaved_ = false;
    gpu::Traffic lastFrame_;
    std::string message_;
    std::map<int, bool> keysDown_;  // as seen last, by GLFW's key
    int shownMolecule_ = -1;        // the panel's choice that is on show
    double frameSeconds_ = 0;       // s, wall clock, smoothed
    int width_ = 0, height_ = 0, shown_ = 0;
};

}  // namespace

int runWindow(const Options& options, gpu::Context& context, Loaded loaded) {
    WindowRun(options, context, std::move(loaded)).go();
    return 0;
}

}  // namespace shoal::app
