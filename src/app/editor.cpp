// `shoal edit`: a window to look at a molecule and change it, while it moves.
#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "app/commands.h"
#include "app/editor_panels.h"
#include "app/interface.h"
#include "app/orbit_camera.h"
#include "app/screenshot.h"
#include "author/edit.h"
#include "core/cache_folder.h"
#include "core/file_watch.h"
#include "core/printable.h"
#include "gpu/context.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

namespace {

constexpr size_t modesShown = 8;

glm::dvec3 middleOf(const Molecule& molecule) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const Vertex& vertex : molecule.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    return (low + high) / 2.0;
}

View viewOf(const Molecule& molecule, const glm::dvec3& from) {
    View view;
    view.fieldOfView = 0.7;
    view.target = middleOf(molecule);
    view.eye = view.target + glm::normalize(from) * (2.7 * std::max(molecule.size(), 1e-3));
    return view;
}

class EditorWindow {
  public:
    EditorWindow(const Options& options, gpu::Context& context)
        : options_(options),
          context_(context),
          window_(context.window()),
          interface_(window_, options.scale),
          cache_(context, cacheFolder()),
          stage_(context, cache_),
          editor_(options.files.front()),
          camera_(viewOf(editor_.document.molecule(), {0.8, 0.45, 1})) {
        glfwSwapInterval(1);
        file_.watch({editor_.document.file()});
        if (editor_.document.molecule().size() > 0)
            editor_.grid = niceStep(editor_.document.molecule().size());
        if (!editor_.document.molecule().hasPins()) editor_.stage.around = StageSettings::Around::drop;
    }

    void go() {
        while (!closes()) {
            glfwPollEvents();
            if (!showFrame()) break;
        }
        if (editor_.document.unsaved() && !closedInOrder_)
            std::cerr << "shoal: warning: what was changed was not saved in "
                      << printable(editor_.document.file()) << "\n";
    }

  private:
    // A tenth of the size or so, in round numbers.
    static double niceStep(double size) { return std::pow(10, std::round(std::log10(size / 20))); }

    bool closes() {
        if (!glfwWindowShouldClose(window_)) return false;
        if (closedInOrder_ || !editor_.document.unsaved()) {
            if (!editor_.document.recovered()) editor_.document.closeInOrder();
            return true;
        }
        editor_.asksToClose = true;
        glfwSetWindowShouldClose(window_, GLFW_FALSE);
        return false;
    }

    bool showFrame() {
        glfwGetFramebufferSize(window_, &width_, &height_);
        if (width_ < 1 || height_ < 1) {
            glfwWaitEventsTimeout(0.1);
            return true;
        }
        follow();
        advance();
        wobble();
        followPlay();
        interface_.begin();
        if (stage_.ready()) stage_.draw(view(), width_, height_);
        EditorAction action = drawPanels();
        work();
        drawMolecule();
        press(action);
        obey(action);
        interface_.end();
        ++shown_;
        const bool last = options_.frames && shown_ >= *options_.frames;
        const bool closing = last || glfwWindowShouldClose(window_);
        if (closing && !options_.screenshot.empty()) saveScreenshot(options_.screenshot, width_, height_);
        glfwSwapBuffers(window_);
        watch();
        return !last;
    }

    void advance() {
        if (!stage_.ready() || !stage_.playing) return;
        const std::string wrong = stage_.advance();
        editor_.troubles.end("run");
        if (!wrong.empty()) tell("run", wrong);
    }

    // What hangs on the molecule, when it has changed; and how it is played.
    void follow() {
        Document& document = editor_.document;
        if (document.version() != editor_.version) {
            editor_.version = document.version();
            editor_.troubles.end("edit");
            if (!document.unsaved()) editor_.troubles.end("saving");
            dropStaleSelection();
            glfwSetWindowTitle(window_,
                               concat("Shoal - ", fileName(), document.unsaved() ? " *" : "").c_str());
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
                editor_.troubles.end(cause);
        } catch (const Error& error) {
            stage_.playing = false;
            tell("stage", error.what());
            editor_.stage = shownStage_;
        }
    }

    void dropStaleSelection() {
        const Molecule& m = editor_.document.molecule();
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
        const double size = editor_.document.molecule().size();
        const Mode& mode = editor_.modes[*editor_.wobbling];
        stage_.wobble(mode, 0.12 * size * std::sin(2.5 * ImGui::GetTime()));
    }

    // ---- What is drawn

    EditorAction drawPanels() {
        EditorAction action = EditorAction::none;
        const auto take = [&action](EditorAction one) {
            if (one != EditorAction::none) action = one;
        };
        take(drawTools(editor_));
        take(drawAdvice(editor_));
        take(drawTransport(editor_, stage_));
        drawHelp(editor_);
        if (drawQuestions(editor_)) {
            closedInOrder_ = true;
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
        }
        return action;
    }

    // What plays is followed; and its middle is that of what the panels leave free.
    View view() const {
        View out = camera_.view();
        const float free = ImGui::GetIO().DisplaySize.y;
        const double lift = free > 0 ? panelArea().bottom / free * std::tan(out.fieldOfView / 2) *
                                           glm::length(out.eye - out.target)
                                     : 0;
        const glm::dvec3 ahead = glm::normalize(out.target - out.eye),
                         up = glm::cross(glm::normalize(glm::cross(ahead, out.up)), ahead);
        out.eye += followed_ - up * lift;
        out.target += followed_ - up * lift;
        return out;
    }

    void followPlay() {
        glm::dvec3 wanted(0);
        const Molecule& m = editor_.document.molecule();
        if (stage_.ready() && stage_.frame() > 0 && stage_.positions().size() == m.vertices.size())
            for (size_t v = 0; v < m.vertices.size(); ++v)
                wanted += (stage_.positions()[v] - m.vertices[v].position) / double(m.vertices.size());
        if (grip_ == Grip::pull) return;  // what is held does not run away from the pointer
        followed_ = stage_.playing ? glm::mix(followed_, wanted, 0.3) : wanted;
    }

    // At rest the draft itself, so that nothing lags behind the pointer.
    std::vector<glm::dvec3> places() const {
        const Molecule& m = editor_.document.molecule();
        const bool atRest = !stage_.ready() || (stage_.frame() == 0 && !editor_.wobbling);
        if (!atRest && stage_.positions().size() == m.vertices.size()) return stage_.positions();
        std::vector<glm::dvec3> out;
        for (const Vertex& vertex : m.vertices)
            out.push_back(vertex.position);
        return out;
    }

    void drawMolecule() {
        const Projector projector(view(), ImGui::GetIO().DisplaySize);
        const std::vector<glm::dvec3> x = places();
        const Molecule& m = editor_.document.molecule();
        std::vector<double> strains;
        for (const Spring& spring : m.springs)
            strains.push_back(glm::distance(x[size_t(spring.a)], x[size_t(spring.b)]) /
                                  std::max(m.restLength(spring), 1e-12) -
                              1);
        editor_.overlay.mirrorAxis = stage_.ready() && stage_.frame() > 0 ? -1 : editor_.mirrorAxis;
        drawOverlay(m, x, strains, projector, editor_.overlay);
        if (box_) {
            ImDrawList* list = ImGui::GetBackgroundDrawList();
            list->AddRect(*box_, ImGui::GetIO().MousePos, IM_COL32(255, 220, 90, 220));
            list->AddRectFilled(*box_, ImGui::GetIO().MousePos, IM_COL32(255, 220, 90, 30));
        }
    }

    // ---- The pointer

    void work() {
        const ImGuiIO& io = ImGui::GetIO();
        Overlay& overlay = editor_.overlay;
        overlay.hoveredVertex.reset();
        overlay.hoveredSpring.reset();
        overlay.hoveredTriangle.reset();
        overlay.chainEnd.reset();
        const Projector projector(view(), io.DisplaySize);
        if (grip_ != Grip::none) return drag(projector);
        if (io.WantCaptureMouse) return;
        if (io.MouseWheel != 0) camera_.zoom(double(io.MouseWheel));
        hover(projector);
        if (!overlay.chain.empty()) overlay.chainEnd = io.MousePos;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) || ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
            grip_ = Grip::pan;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) click(projector);
    }

    void hover(const Projector& projector) {
        const std::vector<glm::dvec3> x = places();
        const Molecule& m = editor_.document.molecule();
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        Overlay& overlay = editor_.overlay;
        overlay.hoveredVertex = vertexAt(x, projector, mouse);
        if (overlay.hoveredVertex || editor_.tool != Tool::select || playing()) return;
        if (overlay.springs) overlay.hoveredSpring = springAt(m, x, projector, mouse);
        if (!overlay.hoveredSpring) overlay.hoveredTriangle = triangleAt(m, x, projector, mouse);
    }

    bool playing() const { return stage_.ready() && (stage_.playing || stage_.frame() > 0); }

    void click(const Projector& projector) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const std::optional<int> vertex = editor_.overlay.hoveredVertex;
        if (playing() && vertex) {
            grip_ = Grip::pull;
            held_ = *vertex;
        } else if (editor_.tool == Tool::vertex && !playing()) {
            addVertexUnder(projector, mouse);
        } else if ((editor_.tool == Tool::spring || editor_.tool == Tool::triangle) && vertex) {
            link(*vertex);
            if (editor_.tool == Tool::spring) grip_ = Grip::link;
        } else if (editor_.tool == Tool::select && ImGui::GetIO().KeyCtrl) {
            grip_ = Grip::box;
            box_ = mouse;
        } else if (editor_.tool == Tool::select && select()) {
            if (vertex && !playing()) beginMove(*vertex);
        } else {
            grip_ = Grip::turn;
            moved_ = 0;
        }
    }

    // What is under the pointer; false: nothing.
    bool select() {
        const Overlay& o = editor_.overlay;
        if (!o.hoveredVertex && !o.hoveredSpring && !o.hoveredTriangle) return false;
        ElementSet& s = editor_.overlay.selection;
        const bool adds = ImGui::GetIO().KeyShift;
        const auto take = [&](std::set<int>& set, int index) {
            if (adds && set.contains(index)) return void(set.erase(index));
            if (!adds && !set.contains(index)) s = {};
            set.insert(index);
        };
        if (o.hoveredVertex)
            take(s.vertices, *o.hoveredVertex);
        else if (o.hoveredSpring)
            take(s.springs, *o.hoveredSpring);
        else
            take(s.triangles, *o.hoveredTriangle);
        return true;
    }

    void beginMove(int vertex) {
        grip_ = Grip::move;
        held_ = vertex;
        before_ = editor_.document.draft();
        start_ = ImGui::GetIO().MousePos;
        editor_.gesture = 0;
        gesture_ = editor_.document.newGesture();
    }

    double snapped(double number) const {
        return editor_.snaps ? std::round(number / editor_.grid) * editor_.grid : number;
    }

    void addVertexUnder(const Projector& projector, ImVec2 mouse) {
        glm::dvec3 place = projector.onPlane(mouse, view().target);
        for (int i = 0; i < 3; ++i)
            place[i] = snapped(place[i]);
        int made = -1;
        editor_.document.edit("add vertex",
                              [&](Draft& draft) { made = addVertexAt(draft, place, editor_.mirrorAxis); });
        editor_.overlay.selection = {{made}, {}, {}};
    }

    // The next vertex of a spring or a triangle.
    void link(int vertex) {
        std::vector<int>& chain = editor_.overlay.chain;
        if (std::find(chain.begin(), chain.end(), vertex) != chain.end()) return;
        chain.push_back(vertex);
        const size_t needed = editor_.tool == Tool::spring ? 2 : 3;
        if (chain.size() < needed) return;
        const std::vector<int> c = chain;
        chain.clear();
        ElementSet made;
        if (editor_.tool == Tool::spring && springBetween(editor_.document.molecule(), c[0], c[1]) < 0)
            editor_.document.edit("add spring", [&](Draft& draft) {
                made.springs.insert(connect(draft, c[0], c[1], editor_.mirrorAxis));
            });
        if (editor_.tool == Tool::triangle)
            editor_.document.edit("add triangle", [&](Draft& draft) {
                const int triangle = addFace(draft, c[0], c[1], c[2], editor_.mirrorAxis);
                if (triangle >= 0) made.triangles.insert(triangle);
            });
        if (!made.empty()) editor_.overlay.selection = made;
    }

    void drag(const Projector& projector) {
        const ImGuiIO& io = ImGui::GetIO();
        const double dx = double(io.MouseDelta.x) / io.DisplaySize.y,
                     dy = double(io.MouseDelta.y) / io.DisplaySize.y;
        const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
        moved_ += std::abs(io.MouseDelta.x) + std::abs(io.MouseDelta.y);
        switch (grip_) {
        case Grip::turn:
            camera_.turn(dx, dy);
            if (!left && moved_ < points(3)) editor_.overlay.selection = {}, editor_.overlay.chain.clear();
            break;
        case Grip::pan:
            camera_.pan(dx, dy);
            break;
        case Grip::move:
            move(projector);
            break;
        case Grip::pull:
            pull(projector, left);
            break;
        case Grip::link:
            editor_.overlay.chainEnd = io.MousePos;
            hover(projector);
            if (!left && editor_.overlay.hoveredVertex && !editor_.overlay.chain.empty())
                link(*editor_.overlay.hoveredVertex);
            break;
        default:
            break;
        }
        const bool other =
            ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
        if (grip_ == Grip::pan ? other : left) return;
        if (grip_ == Grip::box) selectBox(projector);
        grip_ = Grip::none;
        box_.reset();
    }

    // By what the pointer has moved since, in the plane through the vertex that faces the eye, or along an
    // axis.
    void move(const Projector& projector) {
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (std::hypot(mouse.x - start_.x, mouse.y - start_.y) < points(3) && !dragging_) return;
        dragging_ = true;
        const glm::dvec3 from = before_.molecule.vertices[size_t(held_)].position;
        glm::dvec3 shift = projector.onPlane(mouse, from) - projector.onPlane(start_, from);
        constexpr int axisKeys[] = {GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
        for (int axis = 0; axis < 3; ++axis)
            if (keys_.held(axisKeys[axis]))
                for (int i = 0; i < 3; ++i)
                    if (i != axis) shift[i] = 0;
        for (int i = 0; i < 3; ++i)
            if (shift[i] != 0) shift[i] = snapped(from[i] + shift[i]) - from[i];
        const std::set<int> which = editor_.overlay.selection.vertices;
        editor_.document.edit(
            "move", [&](Draft& draft) { moveVertices(draft, before_, which, shift, editor_.mirrorAxis); },
            gesture_);
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragging_ = false;
    }

    void pull(const Projector& projector, bool left) {
        stage_.pull.reset();
        if (!left || size_t(held_) >= stage_.positions().size()) return;
        stage_.pull = EditorStage::Pull{
            held_, projector.onPlane(ImGui::GetIO().MousePos, stage_.positions()[size_t(held_)])};
    }

    void selectBox(const Projector& projector) {
        const ImVec2 a = *box_, b = ImGui::GetIO().MousePos;
        const std::vector<glm::dvec3> x = places();
        if (!ImGui::GetIO().KeyShift) editor_.overlay.selection = {};
        for (size_t v = 0; v < x.size(); ++v) {
            const auto p = projector.place(x[v]);
            if (p && p->x >= std::min(a.x, b.x) && p->x <= std::max(a.x, b.x) && p->y >= std::min(a.y, b.y) &&
                p->y <= std::max(a.y, b.y))
                editor_.overlay.selection.vertices.insert(int(v));
        }
    }

    // ---- The keyboard

    void press(EditorAction& action) {
        keys_.look(!ImGui::GetIO().WantTextInput && !editor_.asksToClose && !editor_.document.recovered());
        const auto pressed = [this](int key) { return keys_.pressed(key); };
        const bool control = keys_.control();
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
        if (c) camera_ = OrbitCamera(viewOf(editor_.document.molecule(), {0.8, 0.45, 1}));
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
            if (pressed(key)) camera_ = OrbitCamera(viewOf(editor_.document.molecule(), from));
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
            glfwSetWindowShouldClose(window_, GLFW_TRUE);
    }

    void choose(Tool tool) {
        editor_.tool = tool;
        editor_.overlay.chain.clear();
    }

    void selectAll() {
        editor_.overlay.selection = {};
        for (size_t v = 0; v < editor_.document.molecule().vertices.size(); ++v)
            editor_.overlay.selection.vertices.insert(int(v));
    }

    void pin() {
        const std::set<int> which =
            withMirror(editor_.document.molecule(), editor_.overlay.selection, editor_.mirrorAxis).vertices;
        if (which.empty()) return;
        const bool pinned = !editor_.document.molecule().vertices[size_t(*which.begin())].pinned;
        editor_.document.edit(pinned ? "pin" : "unpin", [&](Draft& draft) {
            for (const int v : which)
                draft.molecule.vertices[size_t(v)].pinned = pinned;
        });
    }

    void flip() {
        const std::set<int> which =
            withMirror(editor_.document.molecule(), editor_.overlay.selection, editor_.mirrorAxis).triangles;
        if (which.empty()) return;
        editor_.document.edit("turn triangles", [&](Draft& draft) { flipTriangles(draft, which); });
    }

    void remove() {
        const ElementSet which = editor_.overlay.selection;
        if (which.empty() || playing()) return;
        if (which.vertices.size() >= editor_.document.molecule().vertices.size())
            return tell("edit", "a molecule needs at least one vertex");
        editor_.overlay.selection = {};
        editor_.document.edit("remove",
                              [&](Draft& draft) { removeSelected(draft, which, editor_.mirrorAxis); });
    }

    // ---- What was asked for

    void obey(EditorAction action) {
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
        editor_.troubles.end("run");
    }

    void stepOnce() {
        editor_.troubles.end("run");
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
            editor_.troubles.end("saving");  // each attempt is told
            tell("saving", concat("Not saved: ", error.what()));
        }
    }

    void reload() {
        try {
            editor_.document.reload();
            editor_.message = "the file was changed by another program: reloaded";
            editor_.troubles.end("file");
            std::cout << "reloaded: " << printable(editor_.document.file()) << std::endl;
        } catch (const Error& error) {
            tell("file", error.what());
        }
    }

    void measure() {
        try {
            editor_.cost = measureCost(context_, cache_, editor_.document.molecule(), editor_.stage);
            editor_.costVersion = editor_.version;
            editor_.troubles.end("cost");
        } catch (const Error& error) {
            tell("cost", error.what());
        }
    }

    void tell(const std::string& cause, const std::string& words) {
        editor_.message.clear();
        if (editor_.troubles.begin(cause, words)) std::cerr << "shoal: warning: " << words << std::endl;
    }

    // A few times a second: what is not saved is kept, and the file is looked at.
    void watch() {
        const auto now = std::chrono::steady_clock::now();
        if (now - watched_ < std::chrono::milliseconds(500)) return;
        watched_ = now;
        Document& document = editor_.document;
        if (grip_ == Grip::none)
            if (const std::optional<std::string> failed = document.keep()) tell("keeping", *failed);
        if (!document.unsaved()) editor_.troubles.end("keeping");
        fileChanged_ |= !file_.changed(glfwGetTime()).empty();
        if (document.recovered() || !fileChanged_) return;
        if (document.changedOnDisk() && document.unsaved())
            return tell("file", "the file was changed by another program; what you changed is not in it");
        fileChanged_ = false;
        if (document.changedOnDisk()) return reload();
        if (editor_.troubles.end("file"))
            std::cout << "as before: " << printable(document.file()) << std::endl;
    }

    std::string fileName() const {
        return std::filesystem::path(editor_.document.file()).filename().string();
    }

    enum class Grip { none, turn, pan, move, pull, link, box };

    const Options& options_;
    gpu::Context& context_;
    GLFWwindow* window_;
    Interface interface_;
    Input& keys_{interface_.input()};
    gpu::ProgramCache cache_;
    EditorStage stage_;
    Editor editor_;
    StageSettings shownStage_;
    OrbitCamera camera_;
    Grip grip_ = Grip::none;
    int held_ = 0;               // a vertex
    Draft before_;               // of a move
    glm::dvec3 followed_{0};     // m: how far what plays has moved
    ImVec2 start_{0, 0};         // of a move
    std::optional<ImVec2> box_;  // a corner
    float moved_ = 0;            // by the pointer, since it went down
    bool dragging_ = false, stale_ = true, closedInOrder_ = false;
    int gesture_ = 0, width_ = 0, height_ = 0, shown_ = 0;
    FileWatch file_;
    bool fileChanged_ = true;  // since it was read, perhaps
    std::chrono::steady_clock::time_point watched_{};
};

}  // namespace

int editCommand(const Options& options) {
    // mistakes in the file are told before there is a window
    readMolecule(options.files.front());
    gpu::ContextOptions wanted;
    wanted.kind = gpu::ContextKind::window;
    wanted.preferWindow = true;
    wanted.width = options.width;
    wanted.height = options.height;
    wanted.title = "Shoal - " + printable(std::filesystem::path(options.files.front()).filename().string());
    gpu::Context context(wanted);
    EditorWindow(options, context).go();
    return 0;
}

}  // namespace shoal::app
