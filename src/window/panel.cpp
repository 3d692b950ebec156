#include "window/panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compile/generate.h"
#include "core/json_build.h"
#include "scene/force_kinds.h"
#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/new_elements.h"

namespace shoal::window {

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

bool Controls::moved(const Plan& plan) const {
    Controls usual(plan);
    const auto same = [](const std::vector<float>& factors) {
        return std::all_of(factors.begin(), factors.end(), [](float factor) { return factor == 1; });
    };
    return gravityFactor != 1 || wind != 1 || drag != 1 || stiffness != 1 || damping != 1 ||
           substeps != usual.substeps || !same(forces) || !same(fields);
}

// Multiplies a number, or each of a list or of an object's members.
static void multiply(JsonValue& value, double factor) {
    if (value.kind == JsonValue::Kind::number) value = toJson(value.number * factor);
    for (JsonValue& item : value.items)
        multiply(item, factor);
    for (JsonMember& member : value.members)
        multiply(member.second, factor);
}

JsonValue withControls(JsonValue root, const Scene& scene, const Controls& controls) {
    const auto multiplyMember = [](JsonValue& object, const char* key, double usual, double factor) {
        if (factor == 1) return;
        if (!object.find(key) && usual != 0) object.add(key, toJson(usual));
        if (object.find(key)) multiply(memberOf(object, key), factor);
    };
    const auto each = [&](const char* list, const auto& edit) {
        if (!root.find(list)) return;
        std::vector<JsonValue>& items = memberOf(root, list).items;
        for (size_t i = 0; i < items.size(); ++i)
            edit(items[i], i);
    };
    multiplyMember(root, "gravity", 0, double(controls.gravityFactor));
    each("fields", [&](JsonValue& field, size_t i) {
        multiplyMember(field, "weight", 1, double(controls.wind) * double(controls.fields[i]));
    });
    each("forces", [&](JsonValue& force, size_t i) {
        if (controls.forces[i] == 1) return;
        std::visit(
            [&](const auto& kind) {
                for (const Key& key : describe(&kind).keys())
                    leaveOut(force, key.name);
                for (JsonMember& member :
                     describe(&kind).write(kind.times(double(controls.forces[i]))).members)
                    force.add(member.first, std::move(member.second));
            },
            *scene.forces[i].shape);
    });
    each("groups", [&](JsonValue& group, size_t) {
        multiplyMember(group, "drag", 0, double(controls.drag));
        multiplyMember(group, "stiffness", 1, double(controls.stiffness));
        multiplyMember(group, "damping", 1, double(controls.damping));
    });
    if (controls.substeps != controls.plannedSubsteps)
        setMember(memberOf(root, "solver"), "substeps", toJson(controls.substeps));
    return root;
}

Panel::Panel(const Scene& scene) : molecules_(moleculesFor(scene.file)) {
    follow(scene);
}

void Panel::follow(const Scene& scene) {
    sceneName_ = scene.name;
    error.clear();
    group_ = std::min(group_, int(scene.groups.size()) - 1);
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

// A part of the panel that folds away.
static bool section(const char* title, bool open) {
    ImGui::Dummy(ImVec2(0, points(1)));
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

Panel::Action Panel::draw(Controls& controls, RunningScene& running, Explanations& explanations,
                          FrameRate& rate, double frameSeconds, const gpu::Traffic& lastFrame,
                          const measure::Diagnostics* diagnostics) {
    Simulation& simulation = running.simulation();
    const float edge = points(12), width = points(304);
    ImGui::SetNextWindowPos(ImVec2(edge, edge));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0),
                                        ImVec2(width, ImGui::GetIO().DisplaySize.y - 2 * edge));
    ImGui::Begin("Shoal", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(points(150));
    Action action = Action::none;
    for (const Action asked :
         {drawClock(controls, simulation), drawForces(controls, simulation), drawGroups(running),
          drawMethod(controls, running), drawTrials(running.document())})
        if (action == Action::none) action = asked;
    drawView(explanations, simulation, rate);
    drawCost(simulation, running.renderer(), frameSeconds, lastFrame, diagnostics);
    ImGui::PopItemWidth();
    ImGui::End();
    return action;
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

Panel::Action Panel::drawForces(Controls& controls, const Simulation& simulation) {
    if (!section("Forces", true)) return Action::none;
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
    slider(any(&Needs::fields), "Fields", controls.wind, 0, 4);
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
    if (!controls.moved(simulation.plan())) return Action::none;
    const bool written = ImGui::SmallButton("Write into the scene");
    tip("The scene takes what these sliders and the substeps now say.");
    return written ? Action::write : Action::none;
}

Panel::Action Panel::drawGroups(const RunningScene& running) {
    if (!section("Molecules", true)) return Action::none;
    const std::vector<Group>& groups = running.scene().groups;
    const Group& group = groups[size_t(group_)];
    if (groups.size() > 1 && ImGui::BeginCombo("Group", group.name.c_str())) {
        for (int g = 0; g < int(groups.size()); ++g)
            if (ImGui::Selectable(concat(groups[size_t(g)].name, "##", g).c_str(), g == group_)) group_ = g;
        ImGui::EndCombo();
    }
    const bool placed =
        group.place.kind == Placement::Kind::grid || group.place.kind == Placement::Kind::list;
    std::optional<JsonValue> count, molecule;
    ImGui::BeginDisabled(group.count == 0 || placed);
    int number = number_.value_or(group.count);
    ImGui::SliderInt("Number", &number, 1, std::max(20000, 2 * group.count), "%d",
                     ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemActive()) number_ = number;
    if (ImGui::IsItemDeactivatedAfterEdit()) count = toJson(number);
    if (!ImGui::IsItemActive()) number_.reset();
    ImGui::EndDisabled();
    const auto name = [](const std::string& file) { return std::filesystem::path(file).stem().string(); };
    if (!group.particle && ImGui::BeginCombo("Kind", name(group.molecule.file).c_str())) {
        for (const std::string& file : molecules_)
            if (ImGui::Selectable(name(file).c_str(), name(file) == name(group.molecule.file)))
                molecule = toJson(file);
        ImGui::EndCombo();
    }
    if (!count && !molecule) return Action::none;
    tried_ = running.document().json();
    JsonValue& says = memberOf(tried_, "groups").items[size_t(group_)];
    if (molecule) setMember(says, "molecule", *molecule);
    if (!count) return Action::tryOut;
    setMember(says, "count", *count);
    if (group.life && group.life->capacity < number) setMember(memberOf(says, "life"), "capacity", *count);
    return Action::tryOut;
}

Panel::Action Panel::drawTrials(const SceneDocument& document) {
    if (!document.tries()) return Action::none;
    Action action = Action::none;
    ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "Tried out, not saved:");
    tip("Numbers, kinds and the solver that were chosen above, or on the command line.");
    ImGui::SameLine();
    if (ImGui::SmallButton("Keep")) action = Action::keep;
    tip("The scene takes them, and saves them with the rest.");
    ImGui::SameLine();
    if (ImGui::SmallButton("Drop")) action = Action::drop;
    tip("Back to what the scene says.");
    return action;
}

// Whatever is chosen goes on from the same state.
Panel::Action Panel::drawMethod(Controls& controls, const RunningScene& running) {
    if (!section("Method", true)) return Action::none;
    const Simulation& simulation = running.simulation();
    Action action = Action::none;
    const std::optional<SolverKind> kind = running.scene().solver.kind;
    if (ImGui::BeginCombo("Solver", kind ? name(*kind) : "auto")) {
        for (const std::string& word : solverWords()) {
            if (!ImGui::Selectable(word.c_str(), solverOf(word) == kind)) continue;
            tried_ = running.document().json();
            setMember(memberOf(tried_, "solver"), "method", toJson(word));
            action = Action::tryOut;
        }
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
        "these substeps. It takes some seconds.");
    if (!error.empty()) ImGui::TextWrapped("%s", error.c_str());
    return path != current ? Action::switchPath : action;
}

void Panel::drawView(Explanations& explanations, const Simulation& simulation, FrameRate& rate) {
    if (!section("View", true)) return;
    ImGui::Checkbox(concat("Keep ", FrameRate::wanted, " frames a second").c_str(), &rate.keeps);
    tip("While something moves, a picture that is slow to draw is smaller, or goes without shadows. Once it "
        "rests, and in what is saved, it is full.");
    const std::string without = told(rate.level());
    if (!without.empty()) ImGui::TextWrapped("moves with %s", without.c_str());
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
                     const gpu::Traffic& lastFrame, const measure::Diagnostics* diagnostics) {
    if (!section("Cost", true)) return;
    ImGui::Text("%.1f frames/s, %s, %s", frameSeconds > 0 ? 1 / frameSeconds : 0.0,
                name(simulation.path().path), name(simulation.plan().groups.front().solver));
    if (diagnostics) drawDiagnostics(*diagnostics);
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
