// The editor's panels: tools and what is selected at the left, advice, motions and cost at the right, playing
// at the bottom.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/editor_cost.h"
#include "app/editor_stage.h"
#include "app/editor_view.h"
#include "app/notices.h"
#include "author/document.h"
#include "molecule/analysis.h"
#include "molecule/findings.h"
#include "molecule/modes.h"

namespace shoal::app {

enum class Tool { select, vertex, spring, triangle };

// All that the panels show and change.
struct Editor {
    Document document;
    StageSettings stage;
    Overlay overlay;
    Tool tool = Tool::select;
    int mirrorAxis = -1;
    bool snaps = false;   // new and moved vertices to a grid
    double grid = 0.01;   // m
    std::string message;  // what was done
    Troubles troubles;
    bool help = false, asksToClose = false;

    // Of the molecule as it is, made anew when it changes.
    int version = -1;
    std::vector<Finding> findings;
    Analysis analysis;
    std::vector<Mode> modes;
    std::optional<size_t> wobbling;  // a mode that is shown
    std::optional<MoleculeCost> cost;
    int costVersion = -1;
    int gesture = 0;  // of a widget that is held

    explicit Editor(const std::string& file) : document(file) {}
};

enum class EditorAction { none, save, undo, redo, play, step, back, rewind, measure };

struct PanelArea {
    float left = 0, right = 0, bottom = 0;  // in the interface's units: what the panels take
};
PanelArea panelArea();

EditorAction drawTools(Editor& editor);
EditorAction drawAdvice(Editor& editor);
EditorAction drawTransport(Editor& editor, EditorStage& stage);
void drawHelp(Editor& editor);
// Questions over all else: what an earlier run left, whether to save before closing. True: the window closes.
bool drawQuestions(Editor& editor);

}  // namespace shoal::app
