#include "app/help.h"

#include <imgui.h>

#include <algorithm>

#include "app/interface.h"

namespace shoal::app {

const HelpRow windowHelp[] = {
    {"left drag", "turn the camera"},
    {"right or middle drag", "move it"},
    {"wheel", "nearer, farther"},
    {"click", "pick a molecule, read its numbers"},
    {"Shift + left button", "forces that follow the mouse"},
    {"Space", "pause, go on"},
    {".", "one step"},
    {"R", "restart"},
    {"1, 2, 3", "from the front, the side, the top"},
    {"4, C", "the scene's own camera"},
    {"5", "follow the picked molecule"},
    {"X", "springs by their strain"},
    {"F", "arrows of the fluid's velocity"},
    {"H", "hide the panels, show them"},
    {"O", "open another scene"},
    {"Ctrl + S", "save what was edited"},
    {"P", "picture, numbered, in the working folder"},
    {"V", "record a video, stop"},
    {"F1, ?", "these keys"},
    {"Escape", "close what is on top, at last the window"},
    {nullptr, nullptr},
};

bool showHelp(const char* title, const HelpRow* rows) {
    bool open = true;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(points(500), screen.x - points(24));
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y - points(24)));
    ImGui::Begin(title, &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
    for (; rows->keys; ++rows) {
        ImGui::TextColored(ImVec4(0.62f, 0.78f, 0.45f, 1), "%s", rows->keys);
        ImGui::SameLine(points(172));
        ImGui::TextUnformatted(rows->what);
    }
    ImGui::End();
    return open;
}

}  // namespace shoal::app
