#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "core/image.h"
#include "gpu/gl.h"
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
                glFinish();  // the panels are drawn in another context
            }
        } catch (const Error&) {
            // a list without one of its pictures
        }
        found = pictures_.emplace(file, std::move(texture)).first;
    }
    return found->second ? &found->second : nullptr;
}

bool pictureRow(ImVec2 size, const DrawPicture& draw, const std::string& name, const std::string& words,
                const std::string& says) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool chosen = ImGui::Selectable("##row", false, ImGuiSelectableFlags_None, ImVec2(0, size.y));
    tip(says);
    const ImVec2 next = ImGui::GetCursorPos();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    draw(*ImGui::GetWindowDrawList(), corner, end);
    ImGui::SetCursorScreenPos(ImVec2(end.x + points(10), corner.y));
    ImGui::BeginGroup();
    ImGui::TextUnformatted(name.c_str());
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.72f, 0.76f, 0.74f, 1));
    ImGui::TextWrapped("%s", words.c_str());
    ImGui::PopStyleColor();
    ImGui::EndGroup();
    // A long description makes a row higher.
    const float below = ImGui::GetItemRectMax().y - end.y;
    ImGui::SetCursorPos(ImVec2(next.x, next.y + std::max(0.0f, below)));
    ImGui::Dummy(ImVec2(0, 0));
    return chosen;
}

bool SceneChooser::drawRow(const ListedScene& scene) {
    const auto picture = [&](ImDrawList& list, ImVec2 low, ImVec2 high) {
        if (const gpu::Texture* texture = pictureOf(scene.file))
            list.AddImage(ImTextureID(intptr_t(texture->id())), low, high);
        else
            list.AddRectFilled(low, high, IM_COL32(70, 76, 82, 255));
    };
    const std::string place = fs::path(scene.file).lexically_relative(folder_).string();
    return pictureRow(ImVec2(points(128), points(72)), picture, scene.name,
                      scene.comment.empty() ? place : scene.comment, scene.file);
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
