#include "window/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/json_build.h"
#include "window/apply_live.h"
#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/new_elements.h"

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

}  // namespace

ScenePanel::ScenePanel(const Scene& scene) : rows_([this](const std::string& key) { return words_[key]; }) {
    rows_.opens = {"emitters"};
    for (const Group& group : scene.groups)
        lives_ |= group.life || group.particle || group.school;
}

ScenePanel::Action ScenePanel::draw(RunningScene& running, bool unsaved, const View& view) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float edge = points(12), width = points(panelWidth);
    ImGui::SetNextWindowPos(ImVec2(std::max(screen.x - width - edge, edge), edge), ImGuiCond_Always);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y - 2 * edge));
    ImGui::SetNextWindowCollapsed(!lives_ && !whole_ && screen.x < points(1000), ImGuiCond_Once);
    ImGui::Begin(whole_ ? "Scene###scene" : "Groups###scene", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    Action action = drawHead(running.document(), unsaved);
    renew(running);
    if (whole_) {
        const Action asked = drawSteps(running, view);
        if (action == Action::none) action = asked;
    }
    rows_.begin(running.scene());
    // of its own, so that what is above stays when it scrolls; as high as it was in the frame before
    const float room = screen.y - edge - ImGui::GetWindowPos().y - ImGui::GetCursorPosY() - points(12);
    ImGui::BeginChild("rows", ImVec2(0, std::clamp(height_, 1.0f, std::max(room, 1.0f))), false,
                      ImGuiWindowFlags_NavFlattened);
    const bool edited =
        whole_ ? rows_.draw(describe(&running.scene()), draft_->json, &running.scene()) : drawGroups(running);
    height_ = ImGui::GetCursorPosY();
    ImGui::EndChild();
    ImGui::End();
    const bool moved = moveHandles(rows_.places(), view, !edited);
    if (edited || moved) {
        draft_->changed = true;
        said_.clear();
        goLive(running);
    }
    const bool holds = gizmo_.holds() || ImGui::IsAnyItemActive();
    if (holds && !broken_.empty()) ImGui::SetTooltip("%s", broken_.c_str());
    if (holds) return action;
    running.release();
    if (!std::exchange(broken_, {}).empty()) {  // what a slider cannot have it gives back
        draft_.reset();
        said_ = ", taken back";
    }
    return action == Action::none && draft() ? Action::change : action;
}

// Takes a draft of what the document says now. What is refused stays in it.
void ScenePanel::renew(RunningScene& running) {
    if (draft_ && !std::exchange(stale_, false)) return;
    stale_ = false;
    const JsonValue& current = running.document().json();
    if (draft_ && refused()) {
        std::vector<std::string> conflicts;
        draft_->json = merged(draft_->base, draft_->json, current, Prefer::mine, "$", conflicts);
        draft_->base = current;
    } else {
        draft_ = Draft{current, current};
    }
    words_["model"].clear();
    for (const Model& model : running.scene().models)
        words_["model"].push_back(model.name);
    words_["group"].clear();
    for (const Group& group : running.scene().groups)
        words_["group"].push_back(group.name);
    words_["of"] = words_["group"];
    running.showColliders(draft_->json);
}

// Lets the run take the draft at once, if it can.
void ScenePanel::goLive(RunningScene& running) {
    broken_.clear();
    try {
        if (running.changeLive(draft_->json))
            draft_.reset();
        else
            running.showColliders(draft_->json);
    } catch (const Error& error) {
        broken_ = error.message();
    }
}

ScenePanel::Action ScenePanel::drawHead(const SceneDocument& document, bool unsaved) {
    Action action = Action::none;
    if (ImGui::Button("Save")) action = Action::save;
    tip("Into the scene's file (Ctrl+S).");
    ImGui::SameLine();
    ImGui::BeginDisabled(!unsaved);
    if (ImGui::Button("Revert")) action = Action::revert;
    ImGui::EndDisabled();
    tip("Back to what the file says.");
    ImGui::SameLine();
    if (toggle("Scene", whole_)) whole_ = !whole_;
    tip("All that the scene's file says: add, copy, remove and change any of it.");
    ImGui::SameLine();
    const std::string file = std::filesystem::path(document.file()).filename().string();
    if (unsaved)
        ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "%s *%s", file.c_str(), said_.c_str());
    else
        ImGui::TextDisabled("%s%s", file.c_str(), said_.c_str());
    tip(concat(unsaved ? "Not saved yet.\n" : "As in the file.\n", document.file()));
    return action;
}

ScenePanel::Action ScenePanel::drawSteps(const RunningScene& running, const View& view) {
    Action action = Action::none;
    const auto button = [&](const char* label, bool may, Action asks, const char* says) {
        ImGui::BeginDisabled(!may);
        if (ImGui::Button(label)) action = asks;
        ImGui::EndDisabled();
        tip(says);
    };
    button("Undo", running.document().before(), Action::undo, "Takes the last change back (Ctrl+Z).");
    ImGui::SameLine();
    button("Redo", running.document().after(), Action::redo, "Does it again (Ctrl+Y).");
    ImGui::SameLine();
    if (ImGui::Button("Keep this view")) {
        JsonValue& camera = memberOf(draft_->json, "camera");
        setMember(camera, "eye", toJson(toMillimetre(view.eye)));
        setMember(camera, "target", toJson(toMillimetre(view.target)));
        draft_->changed = true;
    }
    tip("Makes what you see now the camera of the scene.");
    if (!refused()) return action;
    ImGui::SameLine();
    button("Drop change", true, Action::undo, "Takes back what cannot run as it is (Ctrl+Z).");
    return action;
}

// Handles for the places of what is open in the panel, if they `may` move: another change in this frame moves
// objects in memory.
bool ScenePanel::moveHandles(const std::vector<JsonRows::Place>& places, const View& view, bool may) {
    std::vector<GizmoHandle> handles;
    for (const JsonRows::Place& place : places)
        handles.push_back(place.handle);
    const std::optional<Gizmo::Change> change = gizmo_.draw(handles, view, may);
    if (!change) return false;
    JsonRows::move(places[change->handle], change->value);
    return true;
}

// Draws what the scene says of its groups.
bool ScenePanel::drawGroups(RunningScene& running) {
    JsonValue& groups = memberOf(draft_->json, "groups");
    const Description& keys = describe(static_cast<const Group*>(nullptr));
    const int open = groups.items.size() == 1 ? ImGuiTreeNodeFlags_DefaultOpen : 0;
    const std::vector<Group>& ran = running.scene().groups;
    bool changed = false;
    for (size_t g = 0; g < groups.items.size(); ++g) {
        if (!ImGui::CollapsingHeader(concat(titleOf(groups.items[g], g), "###", g).c_str(), open)) continue;
        ImGui::PushID(int(g));
        const std::optional<size_t> planned = planGroupOf(running.simulation().plan(), g);
        if (planned && ran[g].life) drawCounts(running.simulation(), *planned);
        changed |= rows_.draw(keys, groups.items[g], g < ran.size() ? &ran[g] : nullptr);
        ImGui::PopID();
    }
    return changed;
}

void ScenePanel::drawCounts(Simulation& simulation, size_t planGroup) {
    Counted& counted = counted_[planGroup];
    const double time = ImGui::GetTime();
    if (counted.time < 0 || time - counted.time > countEvery)
        counted = {simulation.lifeCounts(planGroup), time};
    const LifeCounts& counts = counted.counts;
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
