// The editor of molecules: the state that its parts share, its panels, and what the pointer does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "author/edit.h"
#include "molecule/analysis.h"
#include "molecule/check.h"
#include "window/editor/overlay.h"
#include "window/editor/stage.h"
#include "window/interface.h"
#include "window/notices.h"
#include "window/orbit_camera.h"

namespace shoal::window {

enum class Tool { select, vertex, spring, triangle };

// All that the panels show and change: the molecule that is edited, how it is shown and played, and what is
// known of it.
struct Editor {
    Document document;
    StageSettings stage;
    EditorOverlay overlay;
    Tool tool = Tool::select;
    int mirrorAxis = -1;
    bool snaps = false;   // new and moved vertices to a grid
    double grid = 0.01;   // m
    std::string message;  // what was done
    double density = 0;   // kg/m^2, to weigh by
    bool help = false, asksToClose = false;

    // Results for the molecule as it is, computed anew when it changes; the cost only on request.
    int version = -1;
    std::vector<Finding> findings;
    Analysis analysis;
    std::vector<Mode> modes;
    std::optional<size_t> wobbling;  // a mode that is shown
    std::optional<MoleculeCost> cost;
    int costVersion = -1;
    int gesture = 0;  // of a widget that is held

    explicit Editor(Document opened) : document(std::move(opened)) {}

    const Molecule& molecule() const { return document.molecule(); }
};

// ---- Panels: tools and what is selected at the left, advice, motions and cost at the right, playing at the
// bottom

const ImVec4 warm{0.98f, 0.72f, 0.3f, 1}, red{1, 0.45f, 0.38f, 1}, calm{0.55f, 0.78f, 0.42f, 1};

enum class EditorAction { none, save, undo, redo, play, step, back, rewind, measure };

struct PanelArea {
    float left = 0, right = 0, bottom = 0;  // in the interface's units: what the panels take
};
PanelArea panelArea();
void beginPanel(const char* title, const ImVec2& place, const ImVec2& size, ImGuiWindowFlags flags = 0);

EditorAction drawTools(Editor& editor);
void drawSelection(Editor& editor);  // the numbers of what is selected, to be read and changed
EditorAction drawAdvice(Editor& editor);
EditorAction drawTransport(Editor& editor, EditorStage& stage, Troubles& troubles);
void drawHelp(Editor& editor);
// Questions over all else: what an earlier run left, whether to save before closing. True: the window closes.
bool drawQuestions(Editor& editor, Troubles& troubles);

// ---- The pointer

// Positions of the vertices as they are drawn, m: at rest those of the draft itself, so that nothing lags
// behind the pointer.
std::vector<glm::dvec3> shownPlaces(const Editor& editor, const EditorStage& stage);

// Turns the view, selects, adds and links, moves what is selected, and pulls at what plays.
class EditorPointer {
  public:
    EditorPointer(Editor& editor, EditorStage& stage, OrbitCamera& camera, const Input& keys)
        : editor_(editor), stage_(stage), camera_(camera), keys_(keys) {}

    void work(const View& view);  // of a frame
    void draw() const;            // the box that it opens
    bool holds() const { return grip_ != Grip::none; }
    bool pulls() const { return grip_ == Grip::pull; }

  private:
    enum class Grip { none, turn, pan, move, pull, link, box };

    void hover(const Projector& projector);
    void click(const Projector& projector, const glm::dvec3& near);
    bool select();
    void beginMove(int vertex);
    double snapped(double number) const;
    void addVertexUnder(const Projector& projector, const glm::dvec3& near);
    void link(int vertex);
    void drag(const Projector& projector);
    void move(const Projector& projector);
    void pull(const Projector& projector, bool left);
    void selectBox(const Projector& projector);

    Editor& editor_;
    EditorStage& stage_;
    OrbitCamera& camera_;
    const Input& keys_;
    Grip grip_ = Grip::none;
    int held_ = 0;               // a vertex
    Draft before_;               // of a move
    ImVec2 start_{0, 0};         // of a move
    std::optional<ImVec2> box_;  // a corner
    float moved_ = 0;            // by the pointer, since it went down
    bool dragging_ = false;
    int gesture_ = 0;
};

}  // namespace shoal::window
