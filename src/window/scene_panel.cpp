#include "window/panel.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

constexpr float panelWidth = 368;    // points
constexpr double countEvery = 0.25;  // s: each reading waits for the GPU

// 12345678 as 12,345,678.
std::string grouped(uint64_t number) {
    std::string out = std::to_string(number);
    for (int at = int(out.size()) - 3; at > 0; at -= 3)
        out.insert(size_t(at), ",");
    return out;
}

// The group's index in the plan that runs, which leaves out groups without molecules.
std::optional<size_t> planGroupOf(const Plan& plan, size_t group) {
    for (size_t g = 0; g < plan.groups.size(); ++g)
        if (plan.groups[g].index == group) return g;
    return {};
}

// Sliders for the looks of a group of molecules; whether the user changed them in this frame. Colours are the
// scene's and are saved; what the molecule's file says is changed for this run only, in `choice`.
bool drawMaterial(Group& group, GroupChoice& choice) {
    Material& material = group.molecule.material;
    const glm::dvec3 first = group.color.value_or(material.color);
    const glm::dvec3 second =
        group.secondColor.value_or(group.color.value_or(material.secondColor.value_or(material.color)));
    bool changed = false;
    const auto color = [&](const char* name, glm::dvec3 shown, std::optional<glm::dvec3>& chosen) {
        const Key& key = *describe(&group).find(name);
        if (!pickColor({inWords(name).c_str(), key.says.sentence.c_str()}, {0, 1}, shown)) return;
        chosen = shown;
        changed = true;
    };
    const auto share = [&](const char* name, double& value, std::optional<double>& chosen) {
        const Key& key = *describe(&material).find(name);
        const std::string says =
            key.says.sentence + " It is not saved here: the molecule's file has its own.";
        if (!slide({name, says.c_str()}, limitOf(key), value)) return;
        chosen = value;
        changed = true;
    };
    if (!group.colorBy) {
        color("color", first, group.color);
        color("secondColor", second, group.secondColor);
    }
    share("roughness", material.roughness, choice.roughness);
    if (!group.molecule.triangles.empty()) share("translucency", material.translucency, choice.translucency);
    if (material.blend != Blend::none) share("opacity", material.opacity, choice.opacity);
    return changed;
}

}  // namespace

void ScenePanel::follow(const Scene& scene) {
    pending_ = lives_ = false;
    groups_.clear();
    for (size_t g = 0; g < scene.groups.size(); ++g) {
        const Group& group = scene.groups[g];
        lives_ |= group.life || group.particle || group.school;
        groups_.emplace_back().group = g;
    }
}

ScenePanel::Action ScenePanel::draw(RunningScene& running, bool unsaved) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float edge = points(12), width = points(panelWidth);
    ImGui::SetNextWindowPos(ImVec2(std::max(screen.x - width - edge, edge), edge), ImGuiCond_Always);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y - 2 * edge));
    ImGui::SetNextWindowCollapsed(!lives_ && screen.x < points(1000), ImGuiCond_Once);
    ImGui::Begin("Groups", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    changed_ = false;
    const Action action = drawHead(running.scene, unsaved);
    for (Edited& group : groups_) {
        ImGui::PushID(int(group.group));
        drawGroup(group, running);
        ImGui::PopID();
    }
    ImGui::End();
    if (action != Action::none) return action;
    if (!pending_ || ImGui::IsAnyItemActive()) return Action::none;
    return Action::rebuild;
}

ScenePanel::Action ScenePanel::drawHead(const Scene& scene, bool unsaved) {
    Action action = Action::none;
    if (ImGui::Button("Save")) action = Action::save;
    tip("Into the scene's file (Ctrl+S).");
    ImGui::SameLine();
    ImGui::BeginDisabled(!unsaved);
    if (ImGui::Button("Revert")) action = Action::revert;
    ImGui::EndDisabled();
    tip("Back to what was saved last.");
    ImGui::SameLine();
    const std::string file = std::filesystem::path(scene.file).filename().string();
    if (unsaved)
        ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "%s *", file.c_str());
    else
        ImGui::TextDisabled("%s%s", file.c_str(), said_.c_str());
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%s", scene.file.c_str(), unsaved ? "Not saved yet." : "As in the file.");
    return action;
}

void ScenePanel::drawGroup(Edited& edited, RunningScene& running) {
    Scene& scene = running.scene;
    Simulation& simulation = running.simulation();
    Renderer& renderer = running.renderer();
    Group& group = scene.groups[edited.group];
    const int open = groups_.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
    if (!ImGui::CollapsingHeader(concat(group.name, "###group").c_str(), open)) return;
    const std::optional<size_t> planGroup = planGroupOf(simulation.plan(), edited.group);
    bool life = false, looks = false, mass = false, school = false, material = false;
    if (group.life) {
        if (planGroup) drawCounts(edited, simulation, *planGroup);
        life = drawEmitters(scene, edited.group, edited.rows);
        if (ImGui::TreeNodeEx("Life and death", open)) {
            life |= drawLife(scene, edited.group, edited.rows);
            ImGui::TreePop();
        }
    }
    if (group.particle && ImGui::TreeNodeEx("Looks", group.life ? 0 : open)) {
        const double before = group.particle->mass;
        looks = drawParticles(*group.particle, group.life.has_value(), edited.rows);
        mass = group.particle->mass != before;  // the plan has it
        ImGui::TreePop();
    }
    if (group.school && ImGui::TreeNodeEx("School", open)) {
        school = edited.rows.draw(*group.school);
        ImGui::TreePop();
    }
    if (!group.particle && ImGui::TreeNodeEx("Looks", group.life ? 0 : open)) {
        material = drawMaterial(group, running.choices.groups[group.name]);
        ImGui::TreePop();
    }
    if (!life && !looks && !school && !material) return;
    changed_ = true;
    said_.clear();
    if (material && planGroup) renderer.changeLooks(*planGroup, group);
    if (school) pending_ |= !planGroup || !simulation.changeSchool(*planGroup, *group.school);
    if (life) pending_ |= !planGroup || !simulation.changeLife(*planGroup, *group.life);
    if (looks) pending_ |= mass || !planGroup || !renderer.changeParticle(*planGroup, *group.particle);
}

void ScenePanel::drawCounts(Edited& edited, Simulation& simulation, size_t planGroup) {
    const double now = ImGui::GetTime();
    if (edited.countedAt < 0 || now - edited.countedAt > countEvery) {
        edited.counts = simulation.lifeCounts(planGroup);
        edited.countedAt = now;
    }
    const LifeCounts& counts = edited.counts;
    const std::string live =
        concat(grouped(uint64_t(counts.live)), " of ", grouped(uint64_t(counts.capacity)), " alive");
    ImGui::ProgressBar(float(counts.live) / float(std::max(1, counts.capacity)), ImVec2(-1, 0), live.c_str());
    tip("Those that live now, and the capacity.");
    if (counts.lost == 0)
        ImGui::TextDisabled("born %s", grouped(counts.born).c_str());
    else
        ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "born %s, lost %s", grouped(counts.born).c_str(),
                           grouped(counts.lost).c_str());
    tip("So far; lost are those that found no place, or whose place was taken.");
}

}  // namespace shoal::window
