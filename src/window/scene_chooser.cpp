#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "core/image.h"
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

static constexpr glm::vec2 pictureSize(128, 72);  // points

const gpu::Texture* SceneChooser::pictureOf(const std::string& file) {
    auto found = pictures_.find(file);
    if (found == pictures_.end()) {
        gpu::Texture texture;
        try {
            const fs::path path = fs::path(file).replace_extension(".png");
            if (fs::exists(path)) {
                const Image image = readPng(path);
                texture = gpu::Texture(*context_, gpu::Format::rgba8, image.width, image.height, "scene");
                texture.upload(gpu::Traffic::Kind::parameters, 0, 0, image.width, image.height,
                               image.pixels.data(), image.pixels.size());
                texture.setLinear(true);
            }
        } catch (const Error&) {
            // a list without one of its pictures
        }
        found = pictures_.emplace(file, std::move(texture)).first;
    }
    return found->second ? &found->second : nullptr;
}

bool SceneChooser::drawRow(const ListedScene& scene) {
    const ImVec2 size(points(pictureSize.x), points(pictureSize.y)), corner = ImGui::GetCursorScreenPos();
    const bool chosen = ImGui::Selectable("##scene", false, ImGuiSelectableFlags_None, ImVec2(0, size.y));
    tip(scene.file);
    const ImVec2 next = ImGui::GetCursorPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    if (const gpu::Texture* picture = pictureOf(scene.file))
        list.AddImage(ImTextureID(intptr_t(picture->id())), corner, end);
    else
        list.AddRectFilled(corner, end, IM_COL32(70, 76, 82, 255));
    ImGui::SetCursorScreenPos(ImVec2(end.x + points(10), corner.y));
    ImGui::BeginGroup();
    ImGui::TextUnformatted(scene.name.c_str());
    const std::string shown =
        scene.comment.empty() ? fs::path(scene.file).lexically_relative(folder_).string() : scene.comment;
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.72f, 0.76f, 0.74f, 1));
    ImGui::TextWrapped("%s", shown.c_str());
    ImGui::PopStyleColor();
    ImGui::EndGroup();
    // A long description makes a row higher.
    const float below = ImGui::GetItemRectMax().y - end.y;
    ImGui::SetCursorPos(ImVec2(next.x, next.y + std::max(0.0f, below)));
    ImGui::Dummy(ImVec2(0, 0));
    return chosen;
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
        if (drawRow(scene)) chosen = scene.file;
        ImGui::PopID();
    }
    ImGui::End();
    open = stays && chosen.empty();
    return chosen;
}

}  // namespace shoal::window
