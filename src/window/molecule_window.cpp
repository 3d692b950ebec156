#include "window/molecule_window.h"

#include <imgui.h>

#include <algorithm>

#include "window/interface.h"

namespace shoal::window {

namespace {

void row(const char* label) {
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(points(96));
}

enum class MoleculeAction { none, follow, close };

// At the bottom, from `left` on. `follows`: the camera does.
MoleculeAction showMolecule(const PickedMolecule& picked, const std::string& group, const Molecule& shape,
                            const MoleculeNumbers& numbers, bool follows, float left) {
    MoleculeAction action = MoleculeAction::none;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = points(300);
    ImGui::SetNextWindowPos(
        ImVec2(std::max(points(12), std::min(left, screen.x - width - points(12))), screen.y - points(12)),
        ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSize(ImVec2(width, 0), ImGuiCond_Always);
    bool open = true;
    ImGui::Begin(concat(group, ", number ", picked.molecule, "###molecule").c_str(), &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoCollapse);
    if (!numbers.alive) ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "It is not alive any more.");
    row("position");
    ImGui::Text("%.3f %.3f %.3f m", numbers.middle.x, numbers.middle.y, numbers.middle.z);
    row("speed");
    ImGui::Text("%.3f m/s", glm::length(numbers.velocity));
    row("velocity");
    ImGui::Text("%.2f %.2f %.2f m/s", numbers.velocity.x, numbers.velocity.y, numbers.velocity.z);
    if (numbers.life) {
        row("age");
        if (numbers.life->y > 1e6)
            ImGui::Text("%.2f s", numbers.life->x);
        else
            ImGui::Text("%.2f of %.2f s", numbers.life->x, numbers.life->y);
    }
    row("kinetic");
    ImGui::Text("%.3g J", numbers.kinetic);
    row("in springs");
    ImGui::Text("%.3g J", numbers.elastic);
    if (numbers.strained >= 0) {
        const Spring& spring = shape.springs[size_t(numbers.strained)];
        row("strain");
        ImGui::Text("%+.1f %%, spring %d (%d-%d)", 100 * numbers.strain, numbers.strained, spring.a,
                    spring.b);
    }
    row("scale");
    ImGui::Text("%.3g%s", numbers.scale,
                !shape.hasPins()   ? ""
                : numbers.released ? ", its pins have let go"
                                   : ", held by its pins");
    if (ImGui::Button(follows ? "Stop following" : "Follow")) action = MoleculeAction::follow;
    ImGui::End();
    return open ? action : MoleculeAction::close;
}

// A ring around it on the screen, at `place` in [0, 1] from the upper left corner.
void markMolecule(const glm::dvec2& place, float radius) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 at(float(place.x) * screen.x, float(place.y) * screen.y);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddCircle(at, radius + points(1), IM_COL32(0, 0, 0, 160), 32, points(3));
    list.AddCircle(at, radius, IM_COL32(255, 214, 90, 255), 32, std::max(1.0f, points(1.5f)));
}

}  // namespace

void drawPicked(OpenScene& open, double aspect, float left) {
    if (!open.explanations->picked || !open.numbers) return;
    if (const auto at = onScreen(open.view(), open.numbers->middle, aspect)) markMolecule(*at, points(14));
    const PickedMolecule& picked = *open.explanations->picked;
    const Group& group = open.running.scene.groups[open.simulation().plan().groups[picked.group].index];
    const MoleculeAction action =
        showMolecule(picked, group.name, group.molecule, *open.numbers, open.follows, left);
    if (action == MoleculeAction::follow) open.follows = !open.follows;
    if (action == MoleculeAction::close) open.forget();
}

}  // namespace shoal::window
