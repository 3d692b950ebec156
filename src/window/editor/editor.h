// The state that the editor's parts share: the molecule that is edited, how it is shown and played, and what
// is known of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "author/document.h"
#include "molecule/analysis.h"
#include "molecule/findings.h"
#include "molecule/modes.h"
#include "window/editor/overlay.h"
#include "window/editor/stage.h"

namespace shoal::window {

enum class Tool { select, vertex, spring, triangle };

// All that the panels show and change.
struct Editor {
    Document document;
    StageSettings stage;
    EditorOverlay overlay;
    Tool tool = Tool::select;
    int mirrorAxis = -1;
    bool snaps = false;   // new and moved vertices to a grid
    double grid = 0.01;   // m
    std::string message;  // what was done
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

    explicit Editor(const std::string& file) : document(file) {}

    const Molecule& molecule() const { return document.molecule(); }
};

}  // namespace shoal::window
