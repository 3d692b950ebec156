#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include "core/printable.h"
#include "window/interface.h"
#include "window/open_scene.h"

namespace shoal::window {

glm::dvec3 underPointer(const View& view) {
    const ImGuiIO& io = ImGui::GetIO();
    return Projector(view, io.DisplaySize).onPlane(io.MousePos, view.target);
}

static bool holdsForces(OpenScene& open) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto& forces = open.simulation().plan().forces;
    return !io.WantCaptureMouse && io.KeyShift && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
           std::any_of(forces.begin(), forces.end(), [](const Force& force) { return force.mouse; });
}

void ScenePointer::holdForces(OpenScene& open) {
    const std::vector<Force>& forces = open.simulation().plan().forces;
    const bool held = ImGui::GetFrameCount() > 0 && holdsForces(open);
    for (size_t i = 0; i < forces.size(); ++i) {
        if (!forces[i].mouse) continue;
        ForceControl& control = open.simulation().parameters.forces[i];
        control.on = held;
        if (held) control.position = underPointer(open.camera.view());
    }
}

void ScenePointer::move(OpenScene& open, int height) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantCaptureMouse || holdsForces(open)) return;
    const double dx = double(io.MouseDelta.x / io.DisplaySize.y),
                 dy = double(io.MouseDelta.y / io.DisplaySize.y);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) open.camera.turn(dx, dy);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
        open.camera.pan(dx, dy);
    if (io.MouseWheel != 0) open.camera.zoom(double(io.MouseWheel));

    constexpr float still = 3;  // points: a click, and not a drag that turns the camera
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) pressedAt_ = io.MousePos;
    if (!ImGui::IsMouseReleased(ImGuiMouseButton_Left) || io.KeyShift || !pressedAt_) return;
    const ImVec2 from = *std::exchange(pressedAt_, {});
    if (std::hypot(io.MousePos.x - from.x, io.MousePos.y - from.y) > points(still)) return;
    open.pick(height);
    if (const auto& picked = open.explanations->picked)
        std::cout << "picked: " << printable(open.simulation().plan().groups[picked->group].name) << " "
                  << picked->molecule << std::endl;
}

}  // namespace shoal::window
