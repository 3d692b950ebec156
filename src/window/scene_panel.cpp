#include "window/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/json_build.h"
#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/molecule_picker.h"

namespace shoal::window {

namespace {

constexpr float panelWidth = 368;    // points
constexpr double countEvery = 0.25;  // s: each reading waits for the GPU

// 12345678 as 12,345,678.
std::string grouped(uint64_t number) {
    std::string out = std::to_string(number);
    for (int position = int(out.size()) - 3; position > 0; position -= 3)
        out.insert(size_t(position), ",");
    return out;
}

// The group's index in the plan that runs, which leaves out groups without molecules.
std::optional<size_t> planGroupOf(const Plan& plan, size_t group) {
    for (size_t g = 0; g < plan.groups.size(); ++g)
        if (plan.groups[g].index == group) return g;
    return {};
}

// To a millimetre.
glm::dvec3 rounded(const glm::dvec3& place) {
    return glm::round(place * 1e3) / 1e3;
}

// Sliders for the looks of a group of molecules; whether the user changed them in this frame. Colours are the
// scene's and are saved; what the molecule's file says is changed for this run only, in `choice`.
bool drawMaterial(Group& group, GroupChoice& choice) {
    Material& material = group.molecule.material;
    const InstanceColors colors = instanceColors(group);
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
        color("color", colors.first, group.color);
        color("secondColor", colors.second, group.secondColor);
        const Key& key = *describe(&group).find("variation");
        double variation = colors.variation;
        if (slide({"variation", key.says.sentence.c_str()}, limitOf(key), variation)) {
            group.variation = variation;
            changed = true;
        }
    }
    share("roughness", material.roughness, choice.roughness);
    if (!group.molecule.triangles.empty()) share("translucency", material.translucency, choice.translucency);
    if (material.blend != Blend::none) share("opacity", material.opacity, choice.opacity);
    return changed;
}

}  // namespace

void ScenePanel::follow(const Scene& scene) {
    pending_ = lives_ = false;
    gizmo_.release();
    if (refused())
        draft_->stale = true;
    else
        draft_.reset();
    groups_.clear();
    for (size_t g = 0; g < scene.groups.size(); ++g) {
        const Group& group = scene.groups[g];
        lives_ |= group.life || group.particle || group.school;
        groups_.emplace_back().group = g;
    }
}

ScenePanel::Action ScenePanel::draw(RunningScene& running, bool unsaved, const View& view) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float edge = points(12), width = points(panelWidth);
    ImGui::SetNextWindowPos(ImVec2(std::max(screen.x - width - edge, edge), edge), ImGuiCond_Always);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y - 2 * edge));
    ImGui::SetNextWindowCollapsed(!lives_ && !whole_ && screen.x < points(1000), ImGuiCond_Once);
    ImGui::Begin("Groups", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    changed_ = false;
    Action action = drawHead(running.scene, unsaved);
    if (whole_) {
        const Action asked = drawWhole(running, view);
        if (action == Action::none) action = asked;
    } else {
        for (Edited& group : groups_) {
            ImGui::PushID(int(group.group));
            drawGroup(group, running);
            ImGui::PopID();
        }
    }
    ImGui::End();
    if (action != Action::none || holds() || ImGui::IsAnyItemActive()) return action;
    if (draft_ && draft_->changed) return Action::change;
    return pending_ ? Action::rebuild : Action::none;
}

ScenePanel::Action ScenePanel::drawHead(const Scene& scene, bool unsaved) {
    Action action = Action::none;
    if (ImGui::Button("Save")) action = Action::save;
    tip("Into the scene's file (Ctrl+S).");
    ImGui::SameLine();
    ImGui::BeginDisabled(!unsaved);
    if (ImGui::Button("Revert")) action = Action::revert;
    ImGui::EndDisabled();
    tip("Back to what the file says.");
    ImGui::SameLine();
    if (toggle("Scene", whole_)) {
        whole_ = !whole_;
        if (!drafted()) draft_.reset();  // groups may have been edited since
    }
    tip("All that the scene's file says: add, copy, remove and change any of it.");
    ImGui::SameLine();
    const std::string file = std::filesystem::path(scene.file).filename().string();
    if (unsaved)
        ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "%s *", file.c_str());
    else
        ImGui::TextDisabled("%s%s", file.c_str(), said_.c_str());
    tip(concat(unsaved ? "Not saved yet.\n" : "As in the file.\n", scene.file));
    return action;
}

ScenePanel::Action ScenePanel::drawWhole(RunningScene& running, const View& view) {
    if (molecules_.empty()) molecules_ = moleculesFor(running.scene.file);
    if (!draft_) {
        const JsonValue current = running.json();
        draft_ = Draft{current, current};
    } else if (std::exchange(draft_->stale, false)) {
        std::vector<std::string> conflicts;
        const JsonValue current = running.json();
        draft_->json = merged(draft_->base, draft_->json, current, Prefer::mine, "$", conflicts);
        draft_->base = current;
    }
    Action action = Action::none;
    const auto button = [&](const char* label, bool may, Action asks, const char* says) {
        ImGui::BeginDisabled(!may);
        if (ImGui::Button(label)) action = asks;
        ImGui::EndDisabled();
        tip(says);
    };
    if (refused()) {
        button("Drop", true, Action::undo, "Takes back what cannot run as it is (Ctrl+Z).");
        ImGui::SameLine();
    }
    button("Undo", running.mayUndo(), Action::undo, "Takes the last change back (Ctrl+Z).");
    ImGui::SameLine();
    button("Redo", running.mayRedo(), Action::redo, "Does it again (Ctrl+Y).");
    ImGui::SameLine();
    if (ImGui::Button("Keep this view")) {
        JsonValue camera = JsonValue::makeObject();
        if (const JsonValue* given = draft_->json.find("camera")) camera = *given;
        setMember(camera, "eye", toJson(rounded(view.eye)));
        setMember(camera, "target", toJson(rounded(view.target)));
        setMember(draft_->json, "camera", std::move(camera));
        draft_->changed = true;
    }
    tip("Makes what you see now the camera of the scene.");
    const auto words = [&](const std::string& key) -> std::vector<std::string> {
        if (key == "molecule") return molecules_;
        std::vector<std::string> out;
        if (key == "model")
            for (const Model& model : running.scene.models)
                out.push_back(model.name);
        if (key == "of" || key == "group")
            for (const Group& group : running.scene.groups)
                out.push_back(group.name);
        return out;
    };
    ImGui::PushID("whole");
    JsonRows rows(words);
    const bool changed = rows.draw(describe(&running.scene), draft_->json);
    ImGui::PopID();
    const bool moved = moveHandles(rows.places(), view, !changed);
    draft_->changed |= changed || moved;
    return action;
}

// Handles for the places of what is open in the panel, if they `may` move: another change in this frame moves
// objects in memory.
bool ScenePanel::moveHandles(const std::vector<JsonRows::Place>& places, const View& view, bool may) {
    std::vector<GizmoHandle> handles;
    for (const JsonRows::Place& place : places)
        handles.push_back({.label = inWords(place.key), .position = place.position});
    const std::optional<Gizmo::Change> change = gizmo_.draw(handles, view, may);
    if (!change) return false;
    const JsonRows::Place& place = places[change->handle];
    setMember(*place.object, place.key, toJson(rounded(change->value.position)));
    return true;
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
    const double time = ImGui::GetTime();
    if (edited.countedAt < 0 || time - edited.countedAt > countEvery) {
        edited.counts = simulation.lifeCounts(planGroup);
        edited.countedAt = time;
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
