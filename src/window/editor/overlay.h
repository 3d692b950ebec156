// The molecule as the editor shows it over the picture: springs, vertices, normals and what is selected,
// drawn as lines by the interface; and what lies under the pointer.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include <imgui.h>

#include "author/edit.h"
#include "core/box.h"
#include "window/orbit_camera.h"

namespace shoal::window {

// Settings of what is drawn over the picture, and the elements to highlight.
struct EditorOverlay {
    bool springs = true, vertices = true, normals = false, numbers = false;
    bool tension = true;                                   // springs by their strain, else in one colour
    double strainShown = 0.05;                             // of full colour
    std::set<int> marked, markedSprings, markedTriangles;  // what advice is about
    ElementSet selection;
    std::optional<int> hoveredVertex, hoveredSpring, hoveredTriangle;
    std::vector<int> chain;  // of a spring or triangle that is being drawn
    std::optional<ImVec2> chainEnd;
    int mirrorAxis = -1;  // of symmetry; -1: none
};

// `strains`: of each spring; empty: not known.
void drawOverlay(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                 const std::vector<double>& strains, const Projector& projector,
                 const EditorOverlay& overlay);
// From squeezed over slack to stretched, as drawn: blue, green, red. `share` in [-1, 1].
ImU32 strainColor(double share, float opacity);

Box boxAround(const Molecule& molecule);

// Under a place, nearest first to the pointer and then to the eye; nothing within reach.
std::optional<int> vertexAt(const std::vector<glm::dvec3>& positions, const Projector& projector,
                            ImVec2 place);
std::optional<int> springAt(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                            const Projector& projector, ImVec2 place);
std::optional<int> triangleAt(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                              const Projector& projector, ImVec2 place);

}  // namespace shoal::window
