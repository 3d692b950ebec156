#include "app/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/interface.h"

namespace shoal::app {

Controls::Controls(const Plan& plan)
    : gravity(plan.gravity), forces(plan.forces.size(), 1.0f), substeps(plan.substeps) {}

void Controls::follow(const Parameters& parameters) {
    gravity = parameters.gravity;
    wind = float(parameters.wind);
    drag = float(parameters.drag);
    stiffness = float(parameters.stiffness);
    damping = float(parameters.damping);
    for (size_t i = 0; i < forces.size(); ++i)
        forces[i] = float(parameters.forces[i].factor);
    substeps = parameters.substeps;
}

void Controls::lead(Parameters& parameters, const Plan& plan, double seconds) const {
    const double share = -std::expm1(-seconds / 0.2);
    const auto follow = [share](double& value, double target) { value += (target - value) * share; };
    parameters.gravity += (gravity * double(gravityFactor) - parameters.gravity) * share;
    follow(parameters.wind, wind);
    follow(parameters.drag, drag);
    follow(parameters.stiffness, stiffness);
    follow(parameters.damping, damping);
    for (size_t i = 0; i < forces.size(); ++i)
        follow(parameters.forces[i].factor, forces[i]);
    // explicit solvers stay within their limit: stiffer springs take more substeps
    parameters.substeps = substepsNeeded(plan, parameters.frameTime, parameters.stiffness, parameters.damping,
                                         parameters.drag, substeps);
}

Panel::Panel(const Scene& scene, std::vector<std::string> moleculeFiles)
    : molecules(std::move(moleculeFiles)), sceneName_(scene.name) {
    for (const Group& group : scene.groups) {
        groupNames_.push_back(group.name.empty() ? group.molecule.name : group.name);
        groupCounts_.push_back(group.count);
        particles_.push_back(group.particle.has_value());
        fixedCount_.push_back(group.count == 0 || group.place.kind == Placement::Kind::grid ||
                              group.place.kind == Placement::Kind::list);
    }
    choice.count = groupCounts_.front();
    for (size_t i = 0; i < scene.forces.size(); ++i) {
        const Force& force = scene.forces[i];
        const std::string name = force.name.empty() ? concat(kindName(force.shape), " ", i + 1) : force.name;
        forceNames_.push_back(force.mouse ? name + " (Shift)" : name);
    }
}

static void heading(const char* text) {
    ImGui::Dummy(ImVec2(0, points(4)));
    ImGui::TextColored(ImVec4(0.62f, 0.78f, 0.45f, 1), "%s", text);
    ImGui::Separator();
}

Panel::Action Panel::draw(Controls& controls, Simulation& simulation, Renderer& renderer, double frameSeconds,
                          const gpu::Traffic& lastFrame) {
    const float edge = points(12), width = points(304);
    ImGui::SetNextWindowPos(ImVec2(edge, edge), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0),
                                        ImVec2(width, ImGui::GetIO().DisplaySize.y - 2 * edge));
    ImGui::Begin("Shoal", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(points(150));
    if (!sceneName_.empty()) ImGui::TextWrapped("%s", sceneName_.c_str());
    Action action = drawClock(controls, simulation);
    drawForces(controls, simulation);
    const Action groupAction = drawGroups(simulation);
    const Action pathAction = drawPath(simulation);
    drawCost(simulation, renderer, frameSeconds, lastFrame);
    ImGui::PopItemWidth();
    ImGui::End();
    return action != Action::none ? action : groupAction != Action::none ? groupAction : pathAction;
}

Panel::Action Panel::drawClock(Controls& controls, const Simulation& simulation) {
    Action action = Action::none;
    ImGui::Text("%.2f s, frame %d", simulation.time(), simulation.frames());
    if (ImGui::Button(controls.paused ? "Run" : "Pause")) controls.paused = !controls.paused;
    ImGui::SameLine();
    if (ImGui::Button("Step")) {
        controls.paused = true;
        action = Action::step;
    }
    ImGui::SameLine();
    if (ImGui::Button("Restart")) action = Action::restart;
    ImGui::SameLine();
    if (ImGui::Button("Camera")) action = Action::resetCamera;
    return action;
}

void Panel::drawForces(Controls& controls, const Simulation& simulation) {
    heading("Forces");
    const auto any = [&](bool Needs::*need) {
        return std::any_of(simulation.plan().groups.begin(), simulation.plan().groups.end(),
                           [&](const GroupPlan& group) { return group.needs.*need; });
    };
    const auto slider = [](bool there, const char* label, float& value, float least, float most,
                           ImGuiSliderFlags flags = 0) {
        if (!there) ImGui::BeginDisabled();
        ImGui::SliderFloat(label, &value, least, most, "x %.2f", flags);
        if (!there) ImGui::EndDisabled();
    };
    slider(any(&Needs::fields), "Wind", controls.wind, 0, 4);
    slider(any(&Needs::gravity), "Gravity", controls.gravityFactor, -1, 3);
    slider(any(&Needs::drag), "Drag", controls.drag, 0, 4);
    slider(any(&Needs::springs), "Stiffness", controls.stiffness, 0.02f, 20, ImGuiSliderFlags_Logarithmic);
    slider(any(&Needs::springDamping), "Damping", controls.damping, 0, 4);
    for (size_t i = 0; i < controls.forces.size(); ++i) {
        ImGui::PushID(int(i));
        slider(true, forceNames_[i].c_str(), controls.forces[i], -4, 4);
        ImGui::PopID();
    }
    ImGui::SliderInt("Substeps", &controls.substeps, 1, 32);
    if (simulation.parameters.substeps > controls.substeps)
        ImGui::TextDisabled("these springs need %d substeps", simulation.parameters.substeps);
}

Panel::Action Panel::drawGroups(const Simulation& simulation) {
    heading("Molecules");
    bool changed = false;
    const auto groupName = [](void* names, int index, const char** out) {
        *out = (*static_cast<std::vector<std::string>*>(names))[size_t(index)].c_str();
        return true;
    };
    if (groupNames_.size() > 1 &&
        ImGui::Combo("Group", &choice.group, groupName, &groupNames_, int(groupNames_.size()))) {
        choice.count = simulation.plan().groups[size_t(choice.group)].count;
        choice.molecule = -1;
    }
    const bool fixed = fixedCount_[size_t(choice.group)];
    if (fixed) ImGui::BeginDisabled();
    ImGui::SliderInt("Number", &choice.count, 1, std::max(20000, 2 * groupCounts_[size_t(choice.group)]),
                     "%d", ImGuiSliderFlags_Logarithmic);
    changed |= ImGui::IsItemDeactivatedAfterEdit();
    if (fixed) ImGui::EndDisabled();
    const auto name = [&](int index) {
        return index < 0 ? std::string("as in the scene")
                         : std::filesystem::path(molecules[size_t(index)]).stem().string();
    };
    if (!particles_[size_t(choice.group)] && ImGui::BeginCombo("Kind", name(choice.molecule).c_str())) {
        for (int i = -1; i < int(molecules.size()); ++i) {
            if (!ImGui::Selectable(name(i).c_str(), i == choice.molecule)) continue;
            choice.molecule = i;
            changed = true;
        }
        ImGui::EndCombo();
    }
    return changed ? Action::rebuild : Action::none;
}

// Both go on from the same state.
Panel::Action Panel::drawPath(const Simulation& simulation) {
    heading("Path");
    const Path now = simulation.path().path;
    path = now;
    const bool compute = simulation.context().info().computeShaders;
    if (!compute) ImGui::BeginDisabled();
    if (ImGui::RadioButton("fused", now == Path::fused)) path = Path::fused;
    if (!compute) ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::RadioButton("ping-pong", now == Path::pingPong)) path = Path::pingPong;
    if (!compute) ImGui::TextDisabled("fused needs OpenGL 4.3");
    return path != now ? Action::switchPath : Action::none;
}

void Panel::drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                     const gpu::Traffic& lastFrame) {
    heading("Cost");
    ImGui::Text("%.1f frames/s, %s, %s", frameSeconds > 0 ? 1 / frameSeconds : 0.0,
                name(simulation.path().path), name(simulation.plan().groups.front().solver));
    ImGui::TextDisabled("%s", simulation.context().info().renderer.c_str());
    if (ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("pass");
        ImGui::TableSetupColumn("calls");
        ImGui::TableSetupColumn("ms a frame");
        ImGui::TableHeadersRow();
        std::vector<gpu::PassTime> times = simulation.timers().report();
        const std::vector<gpu::PassTime> drawing = renderer.timers().report();
        times.insert(times.end(), drawing.begin(), drawing.end());
        for (const gpu::PassTime& pass : times) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%d", pass.calls);
            ImGui::TableNextColumn();
            ImGui::Text("%.3f", pass.median * 1e3);
        }
        ImGui::EndTable();
    }
    if (ImGui::BeginTable("bus", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("bus, bytes a frame");
        ImGui::TableSetupColumn("up");
        ImGui::TableSetupColumn("back");
        ImGui::TableHeadersRow();
        using Kind = gpu::Traffic::Kind;
        const std::pair<const char*, Kind> kinds[] = {
            {"state", Kind::state}, {"parameters", Kind::parameters}, {"control", Kind::control}};
        for (const auto& [word, kind] : kinds) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(word);
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(lastFrame.up(kind)));
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(lastFrame.down(kind)));
        }
        ImGui::EndTable();
    }
    ImGui::Text("state %.1f MiB", double(simulation.stateBytes()) / (1 << 20));
}

}  // namespace shoal::app
