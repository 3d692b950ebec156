#include "window/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compile/generate.h"
#include "run/data_paths.h"
#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

std::vector<std::string> shippedMolecules() {
    std::vector<std::string> files;
    std::error_code code;
    for (const auto& entry : std::filesystem::directory_iterator(moleculeFolder(), code)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == ".json" && name.find(".schema.") == std::string::npos)
            files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

Controls::Controls(const Plan& plan)
    : gravity(plan.gravity),
      forces(plan.forces.size(), 1.0f),
      fields(plan.fieldCount, 1.0f),
      substeps(plan.substeps),
      plannedSubsteps(plan.substeps) {}

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

void Controls::follow(const Plan& plan) {
    gravity = plan.gravity;
    forces.resize(plan.forces.size(), 1.0f);
    fields.resize(plan.fieldCount, 1.0f);
    if (substeps == plannedSubsteps) substeps = plan.substeps;
    plannedSubsteps = plan.substeps;
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
    parameters.fields.resize(fields.size(), 1);
    for (size_t i = 0; i < fields.size(); ++i)
        follow(parameters.fields[i], fields[i]);
    // explicit solvers stay within their limit: stiffer springs take more substeps
    parameters.substeps = substepsNeeded(plan, parameters.frameTime, parameters.stiffness, parameters.damping,
                                         parameters.drag, substeps);
}

Panel::Panel(const Scene& scene) : molecules_(shippedMolecules()) {
    follow(scene);
}

void Panel::follow(const Scene& scene) {
    sceneName_ = scene.name;
    error.clear();
    std::vector<Listed> before = std::move(groups_);
    groups_.clear();
    for (const Group& group : scene.groups) {
        Listed listed;
        listed.name = group.name;
        listed.count = listed.chosen = group.count;
        listed.particles = group.particle.has_value();
        listed.fixed = group.count == 0 || group.place.kind == Placement::Kind::grid ||
                       group.place.kind == Placement::Kind::list;
        for (const Listed& old : before) {
            if (old.name != listed.name) continue;
            listed.molecule = old.molecule;
            if (old.chosen != old.count) listed.chosen = old.chosen;
        }
        groups_.push_back(std::move(listed));
    }
    group_ = std::min(group_, int(groups_.size()) - 1);
    const auto nameOf = [](const auto& item, size_t index) {
        return item.name.empty() ? concat(kindName(*item.shape), " ", index + 1) : item.name;
    };
    fieldNames_.clear();
    for (size_t i = 0; i < scene.fields.size(); ++i)
        fieldNames_.push_back(nameOf(scene.fields[i], i));
    forceNames_.clear();
    for (size_t i = 0; i < scene.forces.size(); ++i)
        forceNames_.push_back(nameOf(scene.forces[i], i) + (scene.forces[i].mouse ? " (Shift)" : ""));
}

void Panel::apply(Choices& choices) const {
    for (const Listed& group : groups_) {
        GroupChoice& choice = choices.groups[group.name];
        choice.count.reset();
        if (group.chosen != group.count) choice.count = group.chosen;
        choice.molecule = group.molecule;
    }
    choices.solver.reset();
    if (solver_) choices.solver = solverOf(solverWords()[size_t(*solver_)]);
}

// A part of the panel that folds away.
static bool section(const char* title, bool open) {
    ImGui::Dummy(ImVec2(0, points(1)));
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

Panel::Action Panel::draw(Controls& controls, Simulation& simulation, Renderer& renderer,
                          Explanations& explanations, double frameSeconds, const gpu::Traffic& lastFrame) {
    const float edge = points(12), width = points(304);
    ImGui::SetNextWindowPos(ImVec2(edge, edge), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0),
                                        ImVec2(width, ImGui::GetIO().DisplaySize.y - 2 * edge));
    ImGui::Begin("Shoal", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(points(150));
    const Action clock = drawClock(controls, simulation);
    drawForces(controls, simulation);
    const Action groups = drawGroups(), method = drawMethod(controls, simulation);
    drawView(explanations, simulation);
    drawCost(simulation, renderer, frameSeconds, lastFrame);
    ImGui::PopItemWidth();
    ImGui::End();
    return clock != Action::none ? clock : groups != Action::none ? groups : method;
}

Panel::Action Panel::drawClock(Controls& controls, const Simulation& simulation) {
    Action action = Action::none;
    if (ImGui::Button("Scenes")) action = Action::scenes;
    tip("Choose another scene (O).");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(sceneName_.c_str());
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
    if (!section("Forces", true)) return;
    const auto any = [&](bool Needs::*need) {
        return std::any_of(simulation.plan().groups.begin(), simulation.plan().groups.end(),
                           [&](const GroupPlan& group) { return group.needs.*need; });
    };
    const auto slider = [](bool enabled, const char* label, float& value, float least, float most,
                           ImGuiSliderFlags flags = 0) {
        ImGui::BeginDisabled(!enabled);
        ImGui::SliderFloat(label, &value, least, most, "x %.2f", flags);
        ImGui::EndDisabled();
    };
    slider(any(&Needs::fields), "Wind", controls.wind, 0, 4);
    slider(any(&Needs::gravity), "Gravity", controls.gravityFactor, -1, 3);
    slider(any(&Needs::drag), "Drag", controls.drag, 0, 4);
    slider(any(&Needs::springs), "Stiffness", controls.stiffness, 0.02f, 20, ImGuiSliderFlags_Logarithmic);
    slider(any(&Needs::springDamping), "Damping", controls.damping, 0, 4);
    for (size_t i = 0; controls.fields.size() > 1 && i < controls.fields.size(); ++i) {
        ImGui::PushID(int(i));
        slider(any(&Needs::fields), fieldNames_[i].c_str(), controls.fields[i], -4, 4);
        ImGui::PopID();
    }
    ImGui::PushID("forces");
    for (size_t i = 0; i < controls.forces.size(); ++i) {
        ImGui::PushID(int(i));
        slider(true, forceNames_[i].c_str(), controls.forces[i], -4, 4);
        ImGui::PopID();
    }
    ImGui::PopID();
}

Panel::Action Panel::drawGroups() {
    if (!section("Molecules", true)) return Action::none;
    bool changed = false;
    Listed& group = groups_[size_t(group_)];
    if (groups_.size() > 1 && ImGui::BeginCombo("Group", group.name.c_str())) {
        for (int g = 0; g < int(groups_.size()); ++g)
            if (ImGui::Selectable(concat(groups_[size_t(g)].name, "##", g).c_str(), g == group_)) group_ = g;
        ImGui::EndCombo();
    }
    ImGui::BeginDisabled(group.fixed);
    ImGui::SliderInt("Number", &group.chosen, 1, std::max(20000, 2 * group.count), "%d",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    changed |= ImGui::IsItemDeactivatedAfterEdit();
    ImGui::EndDisabled();
    const auto name = [](const std::string& file) {
        return file.empty() ? std::string("as in the scene") : std::filesystem::path(file).stem().string();
    };
    if (!group.particles && ImGui::BeginCombo("Kind", name(group.molecule).c_str())) {
        const auto choose = [&](const std::string& file) {
            if (!ImGui::Selectable(name(file).c_str(), file == group.molecule)) return;
            group.molecule = file;
            changed = true;
        };
        choose({});
        for (const std::string& file : molecules_)
            choose(file);
        ImGui::EndCombo();
    }
    return changed ? Action::rebuild : Action::none;
}

// Whatever is chosen goes on from the same state.
Panel::Action Panel::drawMethod(Controls& controls, const Simulation& simulation) {
    if (!section("Method", true)) return Action::none;
    Action action = Action::none;
    const std::vector<std::string>& words = solverWords();
    const char* shown = solver_ ? words[size_t(*solver_)].c_str() : "as in the scene";
    if (ImGui::BeginCombo("Solver", shown)) {
        if (ImGui::Selectable("as in the scene", !solver_)) solver_.reset(), action = Action::rebuild;
        for (int i = 0; i < int(words.size()); ++i)
            if (ImGui::Selectable(words[size_t(i)].c_str(), solver_ == i))
                solver_ = i, action = Action::rebuild;
        ImGui::EndCombo();
    }
    ImGui::SliderInt("Substeps", &controls.substeps, 1, 32);
    if (simulation.parameters.substeps > controls.substeps)
        ImGui::TextDisabled("these springs need %d substeps", simulation.parameters.substeps);
    const Path current = simulation.path().path;
    path = current;
    if (ImGui::RadioButton("fused", current != Path::pingPong)) path = Path::fused;
    ImGui::SameLine();
    if (ImGui::RadioButton("ping-pong", current == Path::pingPong)) path = Path::pingPong;
    if (current == Path::fragments) ImGui::TextDisabled("fused runs in fragment shaders");
    if (ImGui::Button("Measure error")) action = Action::measure;
    tip("A few molecules of the scene's start against the double-precision reference, with this solver and "
        "these substeps. The window waits for it some seconds.");
    if (!error.empty()) ImGui::TextWrapped("%s", error.c_str());
    return path != current ? Action::switchPath : action;
}

void Panel::drawView(Explanations& explanations, const Simulation& simulation) {
    if (!section("View", true)) return;
    ExplanationSettings& settings = explanations.settings;
    ImGui::Checkbox("Springs (X)", &settings.springs);
    if (settings.springs) {
        float share = float(100 * settings.strainShown);
        if (ImGui::SliderFloat("full colour at", &share, 0.1f, 100, "%.1f %%",
                               ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
            settings.strainShown = double(share) / 100;
    }
    const bool flows = simulation.plan().fieldCount > 0 || !simulation.plan().forces.empty();
    ImGui::BeginDisabled(!flows);
    ImGui::Checkbox("Flow (F)", &settings.field);
    ImGui::EndDisabled();
    if (!settings.field) return;
    ImGui::Combo("across", &settings.across, "x\0y\0z\0");
    float shift = float(settings.sliceShift);
    if (ImGui::DragFloat("shift", &shift, 0.02f, -1e4f, 1e4f, "%.2f m")) settings.sliceShift = double(shift);
    ImGui::TextDisabled("longest arrows %.2f m/s", explanations.fastest());
}

void Panel::drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                     const gpu::Traffic& lastFrame) {
    if (!section("Cost", true)) return;
    ImGui::Text("%.1f frames/s, %s, %s", frameSeconds > 0 ? 1 / frameSeconds : 0.0,
                name(simulation.path().path), name(simulation.plan().groups.front().solver));
    ImGui::TextDisabled("%s", simulation.context().info().renderer.c_str());
    drawTimes(simulation.timers(), renderer.timers());
    if (ImGui::BeginTable("bus", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("bus, bytes a frame");
        ImGui::TableSetupColumn("up");
        ImGui::TableSetupColumn("back");
        ImGui::TableHeadersRow();
        for (int i = 0; i < gpu::Traffic::kinds; ++i) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(gpu::Traffic::names[i]);
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(lastFrame.uploaded[i]));
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(lastFrame.readBack[i]));
        }
        ImGui::EndTable();
    }
    ImGui::Text("state %.1f MiB", double(simulation.stateBytes()) / (1 << 20));
}

}  // namespace shoal::window
