#include "window/molecule_picker.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/data_paths.h"
#include "molecule/molecule_file.h"
#include "window/interface.h"
#include "window/new_elements.h"
#include "window/notices.h"

namespace shoal::window {

namespace fs = std::filesystem;

void MoleculePicker::list(const std::string& sceneFile) {
    listed_.clear();
    for (const std::string& name : moleculesFor(sceneFile)) {
        Listed listed{name, {}, {}};
        try {
            listed.shape = readMolecule(moleculeFile(name, sceneFile));
            const std::string& comment = listed.shape.comment;
            const size_t end = comment.find(". ");
            listed.words = end == std::string::npos ? comment : comment.substr(0, end + 1);
        } catch (const Error& error) {
            listed.words = error.what();
        }
        listed_.push_back(std::move(listed));
    }
}

std::optional<std::string> MoleculePicker::drawList(const std::string& sceneFile) {
    std::optional<std::string> chosen;
    const float width = points(340);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 0.8f * ImGui::GetIO().DisplaySize.y));
    if (!ImGui::BeginPopup("molecules")) return chosen;
    if (ImGui::IsWindowAppearing()) list(sceneFile);
    for (const Listed& listed : listed_) {
        ImGui::PushID(listed.name.c_str());
        const auto picture = [&](ImDrawList& list, ImVec2 low, ImVec2 high) {
            drawMolecule(listed.shape, list, low, high);
        };
        if (pictureRow(ImVec2(points(64), points(64)), picture, fs::path(listed.name).stem().string(),
                       listed.words, listed.name)) {
            chosen = listed.name;
            ImGui::CloseCurrentPopup();
        }
        ImGui::PopID();
    }
    ImGui::EndPopup();
    return chosen;
}

std::optional<std::string> MoleculePicker::choose(const Row& row, const std::string& current,
                                                  const std::string& sceneFile) {
    ImGui::PushID(row.label);
    beginRow(row);
    if (ImGui::Button(concat(fs::path(current).stem().string(), "###current").c_str(), ImVec2(-1, 0)))
        ImGui::OpenPopup("molecules");
    tip(current);
    const std::optional<std::string> chosen = drawList(sceneFile);
    ImGui::PopID();
    return chosen == current ? std::nullopt : chosen;
}

std::optional<std::string> MoleculePicker::add(const char* label, const std::string& sceneFile) {
    if (ImGui::SmallButton(label)) ImGui::OpenPopup("molecules");
    return drawList(sceneFile);
}

void drawMolecule(const Molecule& shape, ImDrawList& list, ImVec2 low, ImVec2 high) {
    list.AddRectFilled(low, high, IM_COL32(70, 76, 82, 255), points(4));
    if (shape.vertices.empty()) return;
    const glm::dvec3 toEye = glm::normalize(glm::dvec3(0.6, 0.5, 1));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), toEye));
    std::vector<glm::dvec3> seen;  // to the right, up, towards the eye; m
    for (const Vertex& vertex : shape.vertices)
        seen.emplace_back(glm::dot(vertex.position, right),
                          glm::dot(vertex.position, glm::cross(toEye, right)),
                          glm::dot(vertex.position, toEye));
    glm::dvec3 least = seen[0], most = seen[0];
    for (const glm::dvec3& place : seen)
        least = glm::min(least, place), most = glm::max(most, place);
    const bool balls = shape.triangles.empty();
    const double radius = balls ? shape.material.pointSize / 2 : 0;
    const double span = std::max({most.x - least.x, most.y - least.y, 1e-9}) + 2 * radius;
    const double scale = 0.86 * double(high.x - low.x) / span;
    const glm::dvec3 middle = 0.5 * (least + most);
    const auto place = [&](const glm::dvec3& p) {
        return ImVec2(float(double(low.x + high.x) / 2 + scale * (p.x - middle.x)),
                      float(double(low.y + high.y) / 2 - scale * (p.y - middle.y)));
    };
    const auto ink = [&](double light) {
        const glm::dvec3 color =
            glm::pow(glm::clamp(light * shape.material.color, 0.0, 1.0), glm::dvec3(1 / 2.2));
        return ImGui::GetColorU32(ImVec4(float(color.x), float(color.y), float(color.z), 1));
    };
    if (balls) {
        std::sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
        for (const glm::dvec3& p : seen)
            for (const double share : {1.0, 0.6})  // of the ball, and of its bright side
                list.AddCircleFilled(place(p + glm::dvec3(-1, 1, 0) * (1 - share) * 0.6 * radius),
                                     float(share * scale * radius), ink(share < 1 ? 1.3 : 0.75), 32);
    }
    std::vector<std::array<glm::dvec3, 3>> faces;
    for (const Triangle& t : shape.triangles)
        faces.push_back({seen[size_t(t.a)], seen[size_t(t.b)], seen[size_t(t.c)]});
    const auto depth = [](const auto& face) { return face[0].z + face[1].z + face[2].z; };
    std::sort(faces.begin(), faces.end(), [&](const auto& a, const auto& b) { return depth(a) < depth(b); });
    for (const auto& [a, b, c] : faces) {
        const glm::dvec3 normal =
            glm::cross(b - a, c - a) / std::max(glm::length(glm::cross(b - a, c - a)), 1e-300);
        const double facing = std::abs(glm::dot(normal, glm::normalize(glm::dvec3(-0.5, 0.6, 0.7))));
        list.AddTriangleFilled(place(a), place(b), place(c), ink(0.35 + 0.9 * facing));
    }
}

}  // namespace shoal::window
