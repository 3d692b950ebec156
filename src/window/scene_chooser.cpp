#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "scene/json/scene_file.h"
#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/notices.h"

namespace shoal::window {

namespace fs = std::filesystem;

void SceneChooser::list(const std::string& from) {
    folder_ = from;
    scenes_ = scenesBelow(from);
    open = true;
}

void SceneChooser::refused(const std::string& file) {
    open = true;
    refused_.watch({});
    refused_.watch(filesOf(file));
}

// The beginning of a text, as much as fits into the rest of the line; the font's letters are all as wide.
static std::string fitting(const std::string& text) {
    const size_t letters =
        size_t(std::max(8.0f, ImGui::GetContentRegionAvail().x / ImGui::CalcTextSize("m").x));
    return text.size() <= letters ? text : text.substr(0, letters - 3) + "...";
}

std::string SceneChooser::draw(bool mustChoose, const std::string& message) {
    bool stays = true;
    beginMiddle("Scenes", mustChoose ? nullptr : &stays, 560);
    if (!message.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 0.62f, 0.5f, 1));
        ImGui::TextWrapped("%s", message.c_str());
        ImGui::PopStyleColor();
        ImGui::Separator();
    }
    std::string chosen;
    if (scenes_.empty()) ImGui::TextWrapped("There is no scene (*.scene.json) below %s.", folder_.c_str());
    for (const ListedScene& scene : scenes_) {
        ImGui::PushID(scene.file.c_str());
        if (ImGui::Button(scene.name.c_str(), ImVec2(points(190), 0))) chosen = scene.file;
        tip(scene.file.c_str());
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        const std::string shown =
            scene.comment.empty() ? fs::path(scene.file).lexically_relative(folder_).string() : scene.comment;
        ImGui::TextDisabled("%s", fitting(shown).c_str());
        if (ImGui::IsItemHovered() && !scene.comment.empty()) {
            ImGui::BeginTooltip();
            ImGui::PushTextWrapPos(points(420));
            ImGui::TextUnformatted(scene.comment.c_str());
            ImGui::PopTextWrapPos();
            ImGui::EndTooltip();
        }
        ImGui::PopID();
    }
    ImGui::End();
    open = stays && chosen.empty();
    return chosen;
}

}  // namespace shoal::window
