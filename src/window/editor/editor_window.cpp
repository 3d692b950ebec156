#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "author/shapes.h"
#include "core/data_paths.h"
#include "core/file.h"
#include "core/file_watch.h"
#include "core/printable.h"
#include "molecule/molecule_file.h"
#include "window/editor/editor.h"
#include "window/window_loop.h"

namespace shoal::window {

namespace {

constexpr size_t modesShown = 8;

View viewOf(const Molecule& molecule, const glm::dvec3& from) {
    View view;
    view.fieldOfView = 0.7;
    const Box box = boxAround(molecule);
    view.target = (box.low + box.high) / 2.0;
    view.eye = view.target + glm::normalize(from) * (2.7 * std::max(molecule.size(), 1e-3));
    return view;
}

class EditorWindow : public WindowLoop {
  public:
    EditorWindow(Document document, const WindowOptions& options, gpu::Context& context)
        : WindowLoop(options, context),
          stage_(context),
          editor_(std::move(document)),
          camera_(viewOf(editor_.molecule(), {0.8, 0.45, 1})) {
        file_.watch({editor_.document.file()});
        if (editor_.molecule().size() > 0) editor_.grid = niceStep(editor_.molecule().size());
        editor_.density = densityOf(editor_.molecule());
        if (!editor_.molecule().hasPins()) editor_.stage.around = StageSettings::Around::drop;
    }

    void run() {
        go();
        if (editor_.document.unsaved() && !closedInOrder_)
            std::cerr << "shoal: warning: what was changed was not saved in "
                      << printable(editor_.document.file()) << "\n";
    }

  private:
    // A tenth of the size or so, in round numbers.
    static double niceStep(double size) { return std::pow(10, std::round(std::log10(size / 20))); }

    bool mayClose() override {
        if (closedInOrder_ || !editor_.document.unsaved()) {
            if (!editor_.document.recovered()) editor_.document.closeInOrder();
            return true;
        }
        editor_.asksToClose = true;
        return false;
    }

    double moves() override { return stage_.playing ? EditorStage::frameRate : 0; }

    void drawPicture() override {
        follow();
        advance();
        wobble();
        followPlay();
        if (stage_.ready()) show(stage_.draw(view(), width(), height()));
    }

    void drawInterface() override {
        EditorAction action = drawPanels();
        pointer_.work(view());
        drawMolecule();
        press(action);
        action_ = action;
    }

    void advance() {
        if (!stage_.ready() || !isDue()) return;
        const std::string wrong = stage_.advance();
        troubles.end("run");
        if (!wrong.empty()) tell("run", wrong);
    }

    // Recomputes what depends on the molecule when it has changed; updates the stage, also for new settings.
    void follow() {
        Document& document = editor_.document;
        if (document.version() != editor_.version) {
            editor_.version = document.version();
            troubles.end("edit");
            if (!document.unsaved()) troubles.end("saving");
            dropStaleSelection();
            entitle(document.file(), document.unsaved());
            if (document.problem().empty()) {
                const Molecule& m = document.molecule();
                editor_.findings = findingsOf(m);
                for (Finding& finding : editor_.findings)
                    if (finding.kind == Finding::Kind::soft)
                        finding.mendBy("Brace it", [](Draft& draft) { braceSoftModes(draft); });
                editor_.analysis = analyse(m, editor_.stage.pinsHold);
                editor_.modes = modesOf(m, editor_.stage.pinsHold && m.hasPins(), modesShown);
                if (editor_.wobbling && *editor_.wobbling >= editor_.modes.size()) editor_.wobbling.reset();
            } else {
                editor_.findings.clear();
                editor_.modes.clear();
                editor_.wobbling.reset();
                stage_.playing = false;
            }
            stale_ = true;
        }
        if (!(editor_.stage == shownStage_)) {
            if (editor_.stage.pinsHold != shownStage_.pinsHold) editor_.version = -1;
            stale_ = true;
        }
        if (!stale_ || !document.problem().empty()) return;
        stale_ = false;
        try {
            stage_.show(document.molecule(), editor_.stage);
            shownStage_ = editor_.stage;
            for (const char* cause : {"stage", "run"})  // another molecule, or played in another way
                troubles.end(cause);
        } catch (const Error& error) {
            stage_.playing = false;
            tell("stage", error.what());
            editor_.stage = shownStage_;
        }
    }

    void dropStaleSelection() {
        const Molecule& m = editor_.molecule();
        ElementSet& s = editor_.overlay.selection;
        const auto drop = [](std::set<int>& set, size_t count) {
            std::erase_if(set, [count](int i) { return size_t(i) >= count; });
        };
        drop(s.vertices, m.vertices.size());
        drop(s.springs, m.springs.size());
        drop(s.triangles, m.triangles.size());
        if (!editor_.overlay.chain.empty() &&
            size_t(*std::max_element(editor_.overlay.chain.begin(), editor_.overlay.chain.end())) >=
                m.vertices.size())
            editor_.overlay.chain.clear();
    }

    void wobble() {
        if (!stage_.ready() || stage_.playing) return;
        if (!editor_.wobbling) return stage_.rest();
        const double size = editor_.molecule().size();
        const Mode& mode = editor_.modes[*editor_.wobbling];
        stage_.wobble(mode, 0.12 * size * std::sin(2.5 * ImGui::GetTime()));
    }

    // ---- What is drawn

    EditorAction drawPanels() {
        EditorAction action = EditorAction::none;
        const auto take = [&action](EditorAction taken) {
            if (taken != EditorAction::none) action = taken;
        };
        take(drawTools(editor_));
        take(drawAdvice(editor_));
        take(drawTransport(editor_, stage_, troubles));
        drawHelp(editor_);
        if (drawQuestions(editor_, troubles)) {
            closedInOrder_ = true;
            close();
        }
        return action;
    }

    // Returns a view that follows the molecule as it plays, and is centred above the panel at the bottom.
    View view() const {
        View out = camera_.view();
        const float free = ImGui::GetIO().DisplaySize.y;
        const double lift = free > 0 ? panelArea().bottom / free * std::tan(out.fieldOfView / 2) *
                                           glm::length(out.eye - out.target)
                                     : 0;
        const glm::dvec3 up = directionsOf(out)[1];
        out.eye += followed_ - up * lift;
        out.target += followed_ - up * lift;
        return out;
    }

    void followPlay() {
        glm::dvec3 wanted(0);
        const Molecule& m = editor_.molecule();
        if (stage_.ready() && stage_.frame() > 0 && stage_.positions().size() == m.vertices.size())
            for (size_t v = 0; v < m.vertices.size(); ++v)
                wanted += (stage_.positions()[v] - m.vertices[v].position) / double(m.vertices.size());
        if (pointer_.pulls()) return;  // what is held does not run away from the pointer
        followed_ = stage_.playing ? glm::mix(followed_, wanted, 0.3) : wanted;
    }

    void drawMolecule() {
        const Projector projector(view(), ImGui::GetIO().DisplaySize);
        const std::vector<glm::dvec3> x = shownPlaces(editor_, stage_);
        const Molecule& m = editor_.molecule();
        std::vector<double> strains;
        for (const Spring& spring : m.springs)
            strains.push_back(glm::distance(x[size_t(spring.a)], x[size_t(spring.b)]) /
                                  std::max(m.restLength(spring), 1e-12) -
                              1);
        editor_.overlay.mirrorAxis = stage_.ready() && stage_.frame() > 0 ? -1 : editor_.mirrorAxis;
        drawOverlay(m, x, strains, projector, editor_.overlay);
        pointer_.draw();
    }

    // ---- The keyboard

    void press(EditorAction& action) {
        keys().look(!ImGui::GetIO().WantTextInput && !editor_.asksToClose && !editor_.document.recovered());
        const auto pressed = [this](int key) { return keys().pressed(key); };
        const bool control = keys().control();
        const bool a = pressed(GLFW_KEY_A), s = pressed(GLFW_KEY_S), z = pressed(GLFW_KEY_Z),
                   y = pressed(GLFW_KEY_Y), shift = ImGui::GetIO().KeyShift, c = pressed(GLFW_KEY_C);
        if (control) {
            if (s) action = EditorAction::save;
            if (z) action = shift ? EditorAction::redo : EditorAction::undo;
            if (y) action = EditorAction::redo;
            if (a) selectAll();
            return;
        }
        if (a) choose(Tool::vertex);
        if (s) choose(Tool::spring);
        if (c) camera_ = OrbitCamera(viewOf(editor_.molecule(), {0.8, 0.45, 1}));
        if (pressed(GLFW_KEY_V)) choose(Tool::select);
        if (pressed(GLFW_KEY_T)) choose(Tool::triangle);
        if (pressed(GLFW_KEY_M)) editor_.mirrorAxis = editor_.mirrorAxis < 0 ? 0 : -1;
        if (pressed(GLFW_KEY_G)) editor_.snaps = !editor_.snaps;
        if (pressed(GLFW_KEY_N)) editor_.overlay.normals = !editor_.overlay.normals;
        if (pressed(GLFW_KEY_P)) pin();
        if (pressed(GLFW_KEY_F)) flip();
        if (pressed(GLFW_KEY_DELETE) || pressed(GLFW_KEY_BACKSPACE)) remove();
        if (pressed(GLFW_KEY_SPACE)) action = EditorAction::play;
        if (pressed(GLFW_KEY_PERIOD)) action = EditorAction::step;
        if (pressed(GLFW_KEY_COMMA)) action = EditorAction::back;
        if (pressed(GLFW_KEY_HOME)) action = EditorAction::rewind;
        if (pressed(GLFW_KEY_F1)) editor_.help = !editor_.help;
        constexpr std::pair<int, glm::dvec3> views[] = {
            {GLFW_KEY_1, {0, 0, 1}}, {GLFW_KEY_2, {1, 0, 0}}, {GLFW_KEY_3, {0, 1, 1e-3}}};
        for (const auto& [key, from] : views)
            if (pressed(key)) camera_ = OrbitCamera(viewOf(editor_.molecule(), from));
        if (pressed(GLFW_KEY_ESCAPE)) escape();
    }

    // First what is begun, then what is selected, then the window.
    void escape() {
        if (editor_.help)
            editor_.help = false;
        else if (!editor_.overlay.chain.empty())
            editor_.overlay.chain.clear();
        else if (!editor_.overlay.selection.empty())
            editor_.overlay.selection = {};
        else
            close();
    }

    void choose(Tool tool) {
        editor_.tool = tool;
        editor_.overlay.chain.clear();
    }

    void selectAll() {
        editor_.overlay.selection = {};
        for (size_t v = 0; v < editor_.molecule().vertices.size(); ++v)
            editor_.overlay.selection.vertices.insert(int(v));
    }

    void pin() {
        const std::set<int> which =
            withMirror(editor_.molecule(), editor_.overlay.selection, editor_.mirrorAxis).vertices;
        if (which.empty()) return;
        const bool pinned = !editor_.molecule().vertices[size_t(*which.begin())].pinned;
        editor_.document.edit(pinned ? "pin" : "unpin", [&](Draft& draft) {
            for (const int v : which)
                draft.molecule.vertices[size_t(v)].pinned = pinned;
        });
    }

    void flip() {
        const std::set<int> which =
            withMirror(editor_.molecule(), editor_.overlay.selection, editor_.mirrorAxis).triangles;
        if (which.empty()) return;
        editor_.document.edit("turn triangles", [&](Draft& draft) { flipTriangles(draft, which); });
    }

    void remove() {
        const ElementSet which = editor_.overlay.selection;
        if (which.empty() || stage_.moved()) return;
        if (which.vertices.size() >= editor_.molecule().vertices.size())
            return tell("edit", "a molecule needs at least one vertex");
        editor_.overlay.selection = {};
        editor_.document.edit("remove",
                              [&](Draft& draft) { removeSelected(draft, which, editor_.mirrorAxis); });
    }

    // ---- What was asked for

    void act(EditorAction action) {
        Document& document = editor_.document;
        switch (action) {
        case EditorAction::save:
            return save();
        case EditorAction::undo:
            if (document.undo()) editor_.message.clear();
            return;
        case EditorAction::redo:
            if (document.redo()) editor_.message.clear();
            return;
        case EditorAction::measure:
            return measure();
        case EditorAction::none:
            return;
        default:
            break;
        }
        if (!stage_.ready() || !document.problem().empty()) return;
        editor_.wobbling.reset();
        stage_.rest();
        if (action == EditorAction::play) stage_.playing = !stage_.playing;
        if (action == EditorAction::step || action == EditorAction::back) stage_.playing = false;
        if (action == EditorAction::step) stepOnce();
        if (action == EditorAction::back) stage_.seek(stage_.frame() - 1);
        if (action == EditorAction::rewind) rewind();
    }

    void rewind() {
        stage_.playing = false;
        stage_.rewind();
        troubles.end("run");
    }

    void stepOnce() {
        troubles.end("run");
        try {
            stage_.step();
        } catch (const Runaway& runaway) {
            tell("run", runaway.what());
        }
    }

    void save() {
        if (!editor_.document.unsaved()) return;
        try {
            editor_.document.save();
            editor_.message = "saved";
        } catch (const Error& error) {
            troubles.end("saving");  // each attempt is told
            tell("saving", concat("Not saved: ", error.what()));
        }
    }

    void reload() {
        try {
            editor_.document.reload();
            editor_.message = "the file was changed by another program: reloaded";
            troubles.end("file");
            std::cout << "reloaded: " << printable(editor_.document.file()) << std::endl;
        } catch (const Error& error) {
            tell("file", error.what());
        }
    }

    void measure() {
        try {
            editor_.cost = measureCost(context(), editor_.molecule(), editor_.stage);
            editor_.costVersion = editor_.version;
            troubles.end("cost");
        } catch (const Error& error) {
            tell("cost", error.what());
        }
    }

    void tell(const std::string& cause, const std::string& words) {
        editor_.message.clear();
        troubles.warn(cause, words);
    }

    // A few times a second: what is not saved is kept, and the file is looked at.
    void obey() override {
        act(std::exchange(action_, EditorAction::none));
        const auto time = std::chrono::steady_clock::now();
        if (time - watched_ < std::chrono::milliseconds(500)) return;
        watched_ = time;
        Document& document = editor_.document;
        if (!pointer_.holds())
            if (const std::optional<std::string> failed = document.keep()) tell("keeping", *failed);
        if (!document.unsaved()) troubles.end("keeping");
        fileChanged_ |= !file_.changed(wallTime()).empty();
        if (document.recovered() || !fileChanged_) return;
        if (document.changedOnDisk() && document.unsaved())
            return tell("file", "the file was changed by another program; what you changed is not in it");
        fileChanged_ = false;
        if (document.changedOnDisk()) return reload();
        if (troubles.end("file")) std::cout << "as before: " << printable(document.file()) << std::endl;
    }

    EditorStage stage_;
    Editor editor_;
    EditorAction action_ = EditorAction::none;  // that was asked for in this frame
    StageSettings shownStage_;
    OrbitCamera camera_;
    EditorPointer pointer_{editor_, stage_, camera_, keys()};
    glm::dvec3 followed_{0};  // m: how far what plays has moved
    bool stale_ = true, closedInOrder_ = false;
    FileWatch file_;
    bool fileChanged_ = true;  // since it was read, perhaps
    std::chrono::steady_clock::time_point watched_{};
};

}  // namespace

// Begins where there is no file with a shape that saving makes one of. Error: the file's, or the shape's.
static Document documentOf(const std::string& file, const std::string& shapeName) {
    std::error_code code;
    if (std::filesystem::exists(file, code)) {
        if (!shapeName.empty()) throw Error(Location{file}, "is there: --shape is for a file that is not");
        return Document(file);
    }
    if (lowerExtension(file) != ".json")
        throw Error(Location{file}, "no such file, and a new one ends in .json");
    const Shape& shape = shapeNamed(shapeName.empty() ? shapes().front().name : shapeName);
    const Mesh mesh = shapeMesh(shape, shape.divisions);
    Molecule begin = makeMolecule(mesh, ofShape(shape, mesh, {})).molecule;
    begin.name = std::filesystem::path(file).stem().string();
    return Document(file, std::move(begin));
}

void runEditor(const std::string& file, const std::string& shape, const WindowOptions& options) {
    Document document = documentOf(file, shape);  // mistakes are told before there is a window
    gpu::ContextOptions wanted = gpu::contextOptions();
    wanted.kind = gpu::ContextKind::window;
    gpu::Context context(wanted);
    EditorWindow(std::move(document), options, context).run();
}

}  // namespace shoal::window
