#include "window/open_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>

#include "core/printable.h"
#include "run/checkpoints.h"
#include "run/data_paths.h"

namespace shoal::window {

OpenScene::OpenScene(RunRequest given, gpu::Context& context, gpu::ProgramCache& cache, Loaded loaded,
                     int width, int height)
    : request(std::move(given)),
      running(request, context, cache, std::move(loaded), width, height),
      controls(running.simulation().plan()),
      panel(running.original()),
      scenePanel(running.scene),
      camera(View::of(running.scene.camera)) {
    explanations = std::make_unique<Explanations>(context, shaderRoot(), running.scene, simulation().plan());
    reload.follow(running, true);
    checkSave(request);
    if (request.resume.empty()) return;
    shoal::resume(request, running.simulation());
    controls.follow(running.simulation().parameters);
}

void OpenScene::follow() {
    const Plan& plan = simulation().plan();
    controls.follow(plan);
    panel.follow(running.original());
    scenePanel.follow(running.scene);
    camera.start(View::of(running.scene.camera));
    reload.follow(running, false);
    const ExplanationSettings settings = explanations->settings;
    const std::optional<PickedMolecule> picked = explanations->picked;
    explanations = std::make_unique<Explanations>(simulation().context(), shaderRoot(), running.scene, plan);
    explanations->settings = settings;
    const bool there =
        picked && picked->group < plan.groups.size() && picked->molecule < plan.groups[picked->group].count;
    if (there) explanations->picked = picked;
    if (!there) forget();
}

void OpenScene::saveIfAsked(bool end) const {
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
    return shoal::saveForInspection(folder, running.original().file, simulation(), runaway);
}

View OpenScene::view() const {
    View out = camera.view();
    out.time = running.simulation().time();
    return out;
}

void OpenScene::drawPicture(double lineWidth) {
    explanations->settings.lineWidth = lineWidth;
    Renderer& renderer = running.renderer();
    explanations->prepare(running.scene, simulation(), view());
    renderer.draw(simulation().state(), view(), explanations->any() ? explanations.get() : nullptr);
}

static double pointRadius(const Group& group) {
    if (group.particle) return 0.5 * group.particle->size.y;
    return group.molecule.triangles.empty() ? 0.5 * group.molecule.material.pointSize : 0;
}

// Reads back the state of all groups.
void OpenScene::pick(const glm::dvec2& place, double aspect, int height) {
    constexpr double near = 5;  // pixels, that a vertex may be missed by
    const View now = view();
    const Ray ray{now.eye, glm::normalize(onTargetPlane(now, place, aspect) - now.eye)};
    const double angle = near * now.fieldOfView / height;
    forget();
    double nearest = std::numeric_limits<double>::infinity();
    const Plan& plan = simulation().plan();
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        if (plan.groups[g].count == 0) continue;
        const Group& group = running.scene.groups[plan.groups[g].index];
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
    numbers = numbersOf(simulation().readMolecule(picked.group, size_t(picked.molecule)),
                        running.scene.groups[group.index].molecule,
                        group.stiffness * simulation().parameters.stiffness);
    if (follows && numbers->alive) camera.follow(numbers->middle);
}

std::optional<glm::dvec2> onScreen(const View& view, const glm::dvec3& place, double aspect) {
    const glm::dvec3 ahead = glm::normalize(view.target - view.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, view.up)), up = glm::cross(right, ahead);
    const glm::dvec3 to = place - view.eye;
    const double depth = glm::dot(to, ahead), half = depth * std::tan(view.fieldOfView / 2);
    if (!(depth > 0)) return {};
    return glm::dvec2(0.5 + 0.5 * glm::dot(to, right) / (half * aspect), 0.5 - 0.5 * glm::dot(to, up) / half);
}

}  // namespace shoal::window
