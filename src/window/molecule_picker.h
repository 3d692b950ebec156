// Molecules to choose from, those that ship and those beside a scene, each with its picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "molecule/molecule.h"
#include "window/edit_widgets.h"

namespace shoal::window {

class MoleculePicker {
  public:
    // A row with a button that says which molecule it is now and lists the others. What was chosen in this
    // frame, as the scene's file names it.
    std::optional<std::string> choose(const Row& row, const std::string& current,
                                      const std::string& sceneFile);
    // A button that lists them, and the same.
    std::optional<std::string> add(const char* label, const std::string& sceneFile);

  private:
    struct Listed {
        std::string name, words;  // as the scene's file names it; its comment's first sentence
        Molecule shape;           // empty where its file cannot be read: the words say why
    };
    void list(const std::string& sceneFile);
    std::optional<std::string> drawList(const std::string& sceneFile);

    std::vector<Listed> listed_;  // read when the list opens
};

// Draws a molecule into a rectangle, seen from the front, the right and above.
void drawMolecule(const Molecule& shape, ImDrawList& list, ImVec2 low, ImVec2 high);

}  // namespace shoal::window
