// The editor's panels: tools and what is selected at the left, advice, motions and cost at the right, playing
// at the bottom.
#pragma once

#include "window/editor/editor.h"
#include "window/notices.h"

namespace shoal::window {

const ImVec4 warm{0.98f, 0.72f, 0.3f, 1}, red{1, 0.45f, 0.38f, 1}, calm{0.55f, 0.78f, 0.42f, 1};

enum class EditorAction { none, save, undo, redo, play, step, back, rewind, measure };

struct PanelArea {
    float left = 0, right = 0, bottom = 0;  // in the interface's units: what the panels take
};
PanelArea panelArea();

EditorAction drawTools(Editor& editor);
void drawSelection(Editor& editor);  // the numbers of what is selected, to be read and changed
EditorAction drawAdvice(Editor& editor);
EditorAction drawTransport(Editor& editor, EditorStage& stage, Troubles& troubles);
void drawHelp(Editor& editor);
// Questions over all else: what an earlier run left, whether to save before closing. True: the window closes.
bool drawQuestions(Editor& editor, Troubles& troubles);

}  // namespace shoal::window
