#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "core/activity.h"
#include "core/error.h"
#include "core/printable.h"
#include "gpu/gl.h"
#include "run/signals.h"
#include "window/captures.h"
#include "window/open_scene.h"
#include "window/viewer_keys.h"
#include "window/window_loop.h"

namespace shoal::window {

namespace {

// The user's requests in a frame, carried out at its end.
struct Wish {
    Panel::Action panel = Panel::Action::none;
    ScenePanel::Action scene = ScenePanel::Action::none;
    std::string open;  // a scene's file
    bool close = false, picture = false;
    std::optional<Prefer> prefer;  // of the file and the window, which both changed
};

class Viewer : public WindowLoop {
  public:
    Viewer(const ViewerOptions& options, gpu::Context& context, std::optional<Loaded> loaded)
        : WindowLoop(options.window, context),
          options_(options),
          chooser_(context),
          loaded_(std::move(loaded)) {
        if (loaded_)
            entitle(loaded_->scene.file, false);
        else
            listScenes();
    }

    void run() {
        const FinishesOnSignal finishes;
        go();
    }

  private:
    void leave() override {
        if (!open_) return;
        captures_.endVideo(open_->running);
        open_->saveIfAsked(true);
        if (open_->unsaved())
            std::cerr << "shoal: warning: what was changed in the window was not saved in "
                      << printable(open_->running.scene().file) << "\n";
    }

    // Not before the user has said what becomes of what is not saved.
    bool mayClose() override {
        if (!open_ || discards_ || !open_->unsaved()) return true;
        asked_ = Wish();
        asked_->close = true;
        return false;
    }

    void drawPicture() override {
        if (loaded_) {
            open_ =
                std::make_unique<OpenScene>(options_.run, context(), std::move(*loaded_), width(), height());
            loaded_.reset();
            if (options_.edits) open_->scenePanel.showWhole();
        }
        if (open_) {
            if (open_->reload.update(open_->running, wallTime())) takeReloaded();
            drawScene();
        }
        if (chooser_.changed(wallTime()) && chooser_.open) listScenes();
    }

    void drawInterface() override {
        wish_ = Wish();
        if (open_) drawOpenScene();
        if (chooser_.open) wish_.open = chooser_.draw(!open_, open_ ? std::string() : troubles.text());
        if (!chooser_.open) troubles.end("opening");
        if (helps_) helps_ = showHelp("Keys", keysHelp);
        pressKeys();
    }

    void obey() override {
        if (!opening_.empty()) return openNow();
        if (open_ && wish_.picture) savePicture();
        if (open_ && wish_.prefer && open_->reload.settle(open_->running, *wish_.prefer)) takeReloaded();
        if (open_) obeyPanels();
        for (const std::string& file : keys().dropped())
            takeDropped(file);
        if (!wish_.open.empty()) askToOpen(wish_.open);
    }

    void drawScene() {
        OpenScene& open = *open_;
        const gpu::Traffic before = context().traffic();
        ScenePointer::holdForces(open);
        const bool steps = isDue() || steps_;
        if (steps) {
            Simulation& simulation = open.simulation();
            open.controls.lead(simulation.parameters, simulation.plan(), simulation.parameters.frameTime);
            advance();
        }
        steps_ = false;
        open.readPicked();
        drawPictureOf(open, steps || keys().acts(), captures_.records() || savesScreenshot());
        // and its files are watched from then on
        const size_t files = context().shaderFiles().size();
        if (std::exchange(shaderFiles_, files) != files) open.reload.follow(open.running, false);
        show(open.running.renderer().picture());
        lastFrame_ = context().traffic() - before;
        if (steps && open.diagnostics) open.diagnostics->follow();
        if (steps) captures_.add(open.running);
    }

    // `force`: a full picture, whatever moves.
    void drawPictureOf(OpenScene& open, bool moves, bool force) {
        try {
            open.picture.draw(
                open, {width(), height(), wallTime(), lastSeconds(), 1.5 * pixelsPerPoint(), moves}, force);
            troubles.end("picture");
        } catch (const Error& error) {  // a program is made when it is needed first
            troubles.warn("picture", error.what());
        }
        if (open.picture.missesRate()) captures_.say(open.picture.rate.whyMissed());
    }

    double moves() override {
        return open_ && !open_->controls.paused ? open_->running.scene().frameRate : 0;
    }
    bool rests() override { return !open_ || open_->picture.rests(); }

    void savePicture() {
        drawPictureOf(*open_, false, true);
        captures_.takePicture(open_->running);
    }

    void drawOpenScene() {
        OpenScene& open = *open_;
        if (!hidden_) {
            wish_.panel = open.panel.draw(open.controls, open.running, *open.explanations, open.picture.rate,
                                          frameSeconds(), lastFrame_, open.diagnostics.get());
            open.drawPicked(points(328), points(open.timeLine.open ? 90 : 12));
            if (const SavedState* state = open.timeLine.draw(points(328), points(392), open.simulation()))
                goTo(*state);
        }
        drawScenePanel();
        if (hidden_ || !open.scenePanel.holds()) pointer_.move(open, height());
        drawNotices();
    }

    // Simulates a frame; a scene that runs away is paused, to be looked at and restarted.
    void advance() {
        try {
            open_->simulation().frame();
            troubles.end("run");
        } catch (const Runaway& runaway) {
            pauseWith(concat(runaway.what(), ". ", open_->saveForInspection(runaway)));
            return;
        } catch (const Error& error) {
            pauseWith(error.what());
            return;
        }
        open_->saveIfAsked(false);
        open_->timeLine.note(open_->simulation());
    }

    void goTo(const SavedState& state) {
        open_->simulation().load(state);
        if (open_->diagnostics) open_->diagnostics->forget();
        open_->controls.paused = true;
        troubles.end("run");
        captures_.say(concat("went to frame ", state.frames, ", paused"));
    }

    void pauseWith(const std::string& message) {
        open_->controls.paused = true;
        troubles.warn("run", message);
    }

    // ---- What was asked for

    // Makes a change that needs another simulation or may fail; a failure is shown, and what ran runs on.
    template <typename Work>
    void change(const Work& work) {
        troubles.attempt("change", work);
        open_->follow();
    }

    // Takes the panel's draft, if it may run; true: none waits to be completed.
    bool changeWhole() {
        ScenePanel& panel = open_->scenePanel;
        if (const JsonValue* draft = panel.draft()) {
            if (troubles.attempt("change", [&] { open_->running.change(*draft); })) {
                panel.accept();
                open_->follow();
            } else {
                panel.refuse();
            }
        }
        return !panel.refused();
    }

    void goBack(bool undo) {
        RunningScene& running = open_->running;
        if (open_->scenePanel.refused()) {
            open_->scenePanel.accept();
            troubles.end("change");
        } else if (undo ? running.document().before() : running.document().after()) {
            change([&] { undo ? running.undo() : running.redo(); });
        }
    }

    // Follows the reloaded scene, and clears earlier failures, which were those of the old files.
    void takeReloaded() {
        open_->follow();
        for (const char* cause : {"change", "run"})
            troubles.end(cause);
    }

    void obeyPanels() {
        RunningScene& running = open_->running;
        // first: what follows may begin another draft
        if (wish_.scene == ScenePanel::Action::change) changeWhole();
        if (wish_.scene == ScenePanel::Action::save) saveScene();
        if (wish_.scene == ScenePanel::Action::undo) goBack(true);
        if (wish_.scene == ScenePanel::Action::redo) goBack(false);
        if (wish_.scene == ScenePanel::Action::revert) {
            open_->scenePanel.accept();
            change([&] { running.revert(); });
        }
        switch (wish_.panel) {
        case Panel::Action::none:
            break;
        case Panel::Action::step:
            steps_ = true;
            break;
        case Panel::Action::restart:
            running.simulation().restart();
            troubles.end("run");
            break;
        case Panel::Action::resetCamera:
            open_->follows = false;
            open_->camera.reset();
            break;
        case Panel::Action::tryOut:
            change([&] { running.change(open_->panel.tried(), true); });
            break;
        case Panel::Action::keep:
            change([&] { running.keepTrials(); });
            break;
        case Panel::Action::drop:
            change([&] { running.dropTrials(); });
            break;
        case Panel::Action::write:
            change([&] { open_->writeControls(); });
            break;
        case Panel::Action::switchPath:
            change([&] { running.switchPath(open_->panel.path); });
            break;
        case Panel::Action::scenes:
            listScenes();
            break;
        case Panel::Action::measure:
            open_->panel.error = methodError(open_->running.scene(), open_->simulation());
            std::cout << open_->panel.error << std::endl;
            break;
        }
    }

    // Opens the scene that was dropped on the window, or adds the molecule or model to the open one.
    void takeDropped(const std::string& file) {
        if (file.ends_with(".scene.json")) return askToOpen(file);
        if (!open_) return troubles.warn("opening", concat(file, ": is no scene (.scene.json)"));
        change([&] { open_->running.add(file); });
    }

    // ---- Opening

    void listScenes() {
        chooser_.list(options_.folder);
        troubles.end("opening");
    }

    void askToOpen(const std::string& file) {
        if (open_ && open_->unsaved()) {
            asked_ = Wish();
            asked_->open = file;
        } else {
            opening_ = file;
        }
    }

    void openNow() {
        if (open_) captures_.endVideo(open_->running);
        const std::string file = std::exchange(opening_, {});
        const Activity opening(concat("opening ", std::filesystem::path(file).filename().string()));
        RunRequest request = options_.run.forAnother();
        try {
            Loaded loaded = loadScene(file, request);
            auto next = std::make_unique<OpenScene>(std::move(request), context(), std::move(loaded), width(),
                                                    height());
            open_ = std::move(next);
            troubles.clear();
            chooser_.open = discards_ = shownUnsaved_ = false;
            std::cout << "opened: " << printable(open_->running.scene().file) << std::endl;
            entitle(open_->running.scene().file, false);
        } catch (const Error& error) {
            troubles.begin("opening", error.what());
            std::cerr << "shoal: warning: not opened: " << error.what() << std::endl;
            chooser_.refused(file);
        }
    }

    // ---- What is edited and saved

    void drawScenePanel() {
        OpenScene& open = *open_;
        const bool changed = open.unsaved();
        if (!changed) troubles.end("saving");
        if (!hidden_) {
            wish_.scene = open.scenePanel.draw(open.running, changed, open.view());
        }
        if (std::exchange(shownUnsaved_, changed) != changed) entitle(open.running.scene().file, changed);
        if (asked_) askAboutUnsaved();
    }

    void askAboutUnsaved() {
        const Wish wanted = *asked_;
        const Answer answer =
            askBeforeLeaving(open_->running.scene().file, wanted.close ? "close" : "open another scene");
        if (answer == Answer::none) return;
        asked_.reset();
        if (answer == Answer::stay || (answer == Answer::save && !saveScene())) return;
        discards_ = answer == Answer::discard;
        if (wanted.close) close();
        if (!wanted.close) opening_ = wanted.open;
    }

    bool saveScene() {
        try {
            if (!changeWhole()) throw Error("what cannot run as it is has to be completed or dropped first");
            open_->running.save();
        } catch (const Error& error) {
            troubles.begin("saving", concat("Not saved: ", error.what()));
            std::cerr << "shoal: warning: not saved: " << error.what() << "\n";
            return false;
        }
        open_->reload.accept(open_->running.scene().file);
        troubles.end("saving");
        open_->scenePanel.say(", saved");
        return true;
    }

    void drawNotices() {
        HotReload& reload = open_->reload;
        captures_.drawLine();
        if (!hidden_) showWarnings(open_->warnings(), points(392), points(open_->timeLine.open ? 90 : 12));
        const bool closed = showNotices(reload.problem(), troubles.text(), points(hidden_ ? 12 : 328),
                                        points(hidden_ ? 12 : 392));
        if (closed) troubles.clear();
        if (asked_) return;
        wish_.prefer = askWhoWins(reload.conflicts());
    }

    // ---- The mouse and the keys

    void pressKeys() {
        keys().look(!ImGui::GetIO().WantCaptureKeyboard);
        if (keys().pressed(GLFW_KEY_F1) || keys().pressed(GLFW_KEY_SLASH)) helps_ = !helps_;
        if (keys().pressed(GLFW_KEY_O) && !asked_ && opening_.empty()) listScenes();
        if (keys().pressed(GLFW_KEY_ESCAPE)) escape();
        if (open_) pressSceneKeys();
    }

    void pressSceneKeys() {
        Controls& controls = open_->controls;
        ExplanationSettings& settings = open_->explanations->settings;
        if (keys().pressed(GLFW_KEY_SPACE)) controls.paused = !controls.paused;
        if (keys().pressed(GLFW_KEY_S) && keys().control()) wish_.scene = ScenePanel::Action::save;
        if (keys().pressed(GLFW_KEY_Z) && keys().control()) wish_.scene = ScenePanel::Action::undo;
        if (keys().pressed(GLFW_KEY_Y) && keys().control()) wish_.scene = ScenePanel::Action::redo;
        if (keys().pressed(GLFW_KEY_R)) wish_.panel = Panel::Action::restart;
        if (keys().pressed(GLFW_KEY_C) || keys().pressed(GLFW_KEY_4))
            wish_.panel = Panel::Action::resetCamera;
        if (keys().pressed(GLFW_KEY_PERIOD)) {
            controls.paused = true;
            wish_.panel = Panel::Action::step;
        }
        if (keys().pressed(GLFW_KEY_X)) settings.springs = !settings.springs;
        if (keys().pressed(GLFW_KEY_F)) settings.field = !settings.field;
        if (keys().pressed(GLFW_KEY_H)) hidden_ = !hidden_;
        if (keys().pressed(GLFW_KEY_T)) open_->timeLine.open = !open_->timeLine.open;
        if (keys().pressed(GLFW_KEY_P)) wish_.picture = true;
        if (keys().pressed(GLFW_KEY_V)) captures_.toggleVideo(open_->running);
        constexpr double quarter = 1.5707963267948966;  // rad
        if (keys().pressed(GLFW_KEY_1)) open_->camera.lookFrom(0, 0);
        if (keys().pressed(GLFW_KEY_2)) open_->camera.lookFrom(quarter, 0);
        if (keys().pressed(GLFW_KEY_3)) open_->camera.lookFrom(0, quarter);
        if (keys().pressed(GLFW_KEY_5) && open_->explanations->picked) open_->follows = !open_->follows;
    }

    // Closes whatever lies on top, the window last.
    void escape() {
        if (helps_)
            helps_ = false;
        else if (chooser_.open && open_)
            chooser_.open = false;
        else if (open_ && open_->explanations->picked)
            open_->forget();
        else
            close();
    }

    const ViewerOptions& options_;
    SceneChooser chooser_;
    std::optional<Loaded> loaded_;     // the first scene, until it is open
    std::unique_ptr<OpenScene> open_;  // null: nothing was chosen yet
    std::string opening_;              // a scene's file
    Wish wish_;
    std::optional<Wish> asked_;  // to close or open, while something is not saved
    bool discards_ = false, shownUnsaved_ = false, steps_ = false;
    size_t shaderFiles_ = 0;
    gpu::Traffic lastFrame_;
    Captures captures_{troubles};
    ScenePointer pointer_;
    bool helps_ = false, hidden_ = false;  // the keys are shown; the panels are not
};

}  // namespace

void runViewer(const ViewerOptions& options, gpu::Context& context, std::optional<Loaded> loaded) {
    Viewer(options, context, std::move(loaded)).run();
}

}  // namespace shoal::window
