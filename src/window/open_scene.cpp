#include "window/open_scene.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <utility>

#include "core/printable.h"
#include "run/checkpoints.h"
#include "window/interface.h"

namespace shoal::window {

OpenScene::OpenScene(RunRequest given, gpu::Context& context, Loaded loaded, int width, int height)
    : request(std::move(given)),
      running(request, context, std::move(loaded), width, height),
      controls(running.simulation().plan()),
      panel(running.scene()),
      scenePanel(running.scene()),
      camera(View::fromCamera(running.scene().camera)) {
    camera.standOn([this](double x, double z) { return groundHeight(running.scene(), x, z); });
    explanations = std::make_unique<Explanations>(context, running.scene(), simulation().plan());
    reload.follow(running, true);
    diagnose();
    checkSave(request);
    if (request.resume.empty()) return;
    shoal::resume(request, running.simulation());
    controls.follow(running.simulation().parameters);
}

void OpenScene::follow() {
    scenePanel.follow();
    if (std::exchange(builds_, running.builds()) == running.builds()) return;
    const Plan& plan = simulation().plan();
    controls.follow(plan);
    panel.follow(running.scene());
    camera.start(View::fromCamera(running.scene().camera));
    reload.follow(running, false);
    timeLine.forget();
    diagnose();
    picture.rate.forget();
    const ExplanationSettings settings = explanations->settings;
    const std::optional<PickedMolecule> picked = explanations->picked;
    explanations = std::make_unique<Explanations>(simulation().context(), running.scene(), plan);
    explanations->settings = settings;
    const bool exists =
        picked && picked->group < plan.groups.size() && picked->molecule < plan.groups[picked->group].count;
    if (exists) explanations->picked = picked;
    if (!exists) forget();
}

void OpenScene::diagnose() {
    if (request.diagnostics)
        diagnostics = std::make_unique<measure::Diagnostics>(running.scene(), simulation());
}

void OpenScene::writeControls() {
    running.change(withControls(running.document().json(), running.scene(), controls));
    const bool paused = controls.paused;
    controls = Controls(simulation().plan());
    controls.paused = paused;
    simulation().parameters = parametersOf(simulation().plan());
}

void OpenScene::saveIfAsked(bool end) {
    const std::vector<int>& frames = request.saveFrames;
    const bool asked = frames.empty() ? end : !end && contains(frames, simulation().frames());
    if (request.save.empty() || !asked) return;
    const auto last = std::max_element(frames.begin(), frames.end());
    const std::string file =
        numbered(request.save, simulation().frames(), frames.size() > 1, last == frames.end() ? 0 : *last);
    saveState(file, simulation());
    std::cout << "saved: " << printable(file) << "\n";
}

std::string OpenScene::saveForInspection(const Runaway& runaway) const {
    const std::string folder = std::filesystem::path(request.save).parent_path().string();
    return shoal::saveForInspection(folder, running.document().file(), simulation(), runaway);
}

std::vector<Warning> OpenScene::warnings() const {
    std::vector<Warning> out = simulation().plan().warnings;
    out.insert(out.end(), simulation().warnings().begin(), simulation().warnings().end());
    return out;
}

View OpenScene::view() const {
    View out = camera.view();
    out.time = running.simulation().time();
    return out;
}

static double pointRadius(const Group& group) {
    if (group.particle) return 0.5 * group.particle->size.y;
    return group.molecule.triangles.empty() ? 0.5 * group.molecule.material.pointSize : 0;
}

// Reads back the state of all groups.
void OpenScene::pick(int height) {
    constexpr double near = 5;  // pixels, that a vertex may be missed by
    const View current = view();
    const Ray ray{current.eye, glm::normalize(underPointer(current) - current.eye)};
    const double angle = near * current.fieldOfView / height;
    forget();
    double nearest = std::numeric_limits<double>::infinity();
    const Plan& plan = simulation().plan();
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        if (plan.groups[g].count == 0) continue;
        const Group& group = running.scene().groups[plan.groups[g].index];
        const std::optional<RayHit> hit =
            firstHit(ray, simulation().snapshot(g), group.molecule, pointRadius(group), angle);
        if (!hit || hit->distance >= nearest) continue;
        nearest = hit->distance;
        explanations->picked = PickedMolecule{g, hit->molecule};
    }
    readPicked();
}

void OpenScene::forget() {
    explanations->picked.reset();
    numbers.reset();
    follows = false;
}

void OpenScene::readPicked() {
    if (!explanations->picked) return;
    const PickedMolecule picked = *explanations->picked;
    const GroupPlan& group = simulation().plan().groups[picked.group];
    numbers = numbersOf(simulation().readMolecules(picked.group, size_t(picked.molecule), 1),
                        running.scene().groups[group.index].molecule,
                        group.stiffness * simulation().parameters.stiffness);
    if (follows && numbers->alive) camera.follow(numbers->middle);
}

// ---- What is shown of the picked molecule

namespace {

void row(const char* label) {
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(points(96));
}

// At `bottom`, from `left` on. `follows`: the camera does. False: the user closed it.
bool showMolecule(const PickedMolecule& picked, const std::string& group, const Molecule& shape,
                  const MoleculeNumbers& numbers, bool& follows, float left, float bottom) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = points(300);
    ImGui::SetNextWindowPos(
        ImVec2(std::max(points(12), std::min(left, screen.x - width - points(12))), screen.y - bottom),
        ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSize(ImVec2(width, 0), ImGuiCond_Always);
    bool open = true;
    ImGui::Begin(concat(group, ", number ", picked.molecule, "###molecule").c_str(), &open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoCollapse);
    if (!numbers.alive) ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "It is not alive any more.");
    row("position");
    ImGui::Text("%.3f %.3f %.3f m", numbers.middle.x, numbers.middle.y, numbers.middle.z);
    row("speed");
    ImGui::Text("%.3f m/s", glm::length(numbers.velocity));
    row("velocity");
    ImGui::Text("%.2f %.2f %.2f m/s", numbers.velocity.x, numbers.velocity.y, numbers.velocity.z);
    if (numbers.life) {
        row("age");
        if (numbers.life->y > 1e6)
            ImGui::Text("%.2f s", numbers.life->x);
        else
            ImGui::Text("%.2f of %.2f s", numbers.life->x, numbers.life->y);
    }
    row("kinetic");
    ImGui::Text("%.3g J", numbers.kinetic);
    row("in springs");
    ImGui::Text("%.3g J", numbers.elastic);
    if (numbers.strained >= 0) {
        const Spring& spring = shape.springs[size_t(numbers.strained)];
        row("strain");
        ImGui::Text("%+.1f %%, spring %d (%d-%d)", 100 * numbers.strain, numbers.strained, spring.a,
                    spring.b);
    }
    row("scale");
    ImGui::Text("%.3g%s", numbers.scale,
                !shape.hasPins()   ? ""
                : numbers.released ? ", its pins have let go"
                                   : ", held by its pins");
    if (ImGui::Button(follows ? "Stop following" : "Follow")) follows = !follows;
    ImGui::End();
    return open;
}

}  // namespace

void OpenScene::drawPicked(float left, float bottom) {
    if (!explanations->picked || !numbers) return;
    if (const auto center = Projector(view(), ImGui::GetIO().DisplaySize).place(numbers->middle)) {  // a ring
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        list.AddCircle(*center, points(14) + points(1), IM_COL32(0, 0, 0, 160), 32, points(3));
        list.AddCircle(*center, points(14), IM_COL32(255, 214, 90, 255), 32, std::max(1.0f, points(1.5f)));
    }
    const PickedMolecule& picked = *explanations->picked;
    const Group& group = running.scene().groups[simulation().plan().groups[picked.group].index];
    if (!showMolecule(picked, group.name, group.molecule, *numbers, follows, left, bottom)) forget();
}

}  // namespace shoal::window
