#include "gl/agreement.h"

#include <algorithm>

#include "simulate/fused.h"
#include "support/catch.h"

namespace shoal::test {

namespace {

Simulation on(const Scene& scene, const SimulationOptions& options) {
    return Simulation(testContext(), compile(scene), options);
}

// For the ping-pong path, which reads fields in one way only.
Scene everySubstep(Scene scene) {
    scene.solver.fieldSampling = FieldSampling::vertexSubstep;
    return scene;
}

Scene withoutColliders(Scene scene) {
    scene.colliders.clear();
    return scene;
}

void compareGroup(const GroupPlan& group, const GroupState& before, const Snapshot& a, const Snapshot& b,
                  const GroupState& touching, const GroupState& free, double duration, Comparison& out) {
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < size_t(group.count); ++m) {
        double position = 0, velocity = 0, normal = 0;
        bool contact = false;
        const double size = group.size * double(group.constants.scales[m]);
        for (size_t i = m * vertices; i < (m + 1) * vertices; ++i) {
            position = std::max(position, glm::length(a.positions[i] - b.positions[i]) / size);
            velocity = std::max(velocity, glm::length(a.velocities[i] - b.velocities[i]) * duration / size);
            normal = std::max(normal, double(glm::length(a.normals[i] - b.normals[i])));
            // A pass that finds no contact hands on what it read: whatever differs in a bit was touched.
            contact |=
                touching.positions[i] != free.positions[i] || touching.velocities[i] != free.velocities[i];
        }
        const bool release = !before.released[m] && (a.released[m] || b.released[m]);
        ++out.molecules;
        out.contacts += contact;
        out.releases += release;
        // whether a pull is above the force may depend on a rounding; the lots that are drawn do not
        const bool disagree = a.released[m] != b.released[m];
        const bool mayRelease = release && (!disagree || group.release.force);
        const bool apart =
            disagree || !(position <= Agreement::tolerance && velocity <= Agreement::tolerance);
        if (apart && (contact || mayRelease)) {
            ++out.excepted;
            out.exempted = std::max(out.exempted, position);
            continue;
        }
        out.wrong += apart;
        out.largest = std::max(out.largest, position);
        out.velocity = std::max(out.velocity, velocity);
        out.normal = std::max(out.normal, normal);
    }
}

}  // namespace

std::string text(const Comparison& c) {
    return concat(c.molecules, " molecules, ", c.contacts, " with contact, ", c.releases, " released, ",
                  c.excepted, " excepted (up to ", c.exempted, "); others apart by ", c.largest,
                  ", velocities ", c.velocity, ", normals ", c.normal);
}

Agreement::Agreement(const Scene& scene, const SimulationOptions& first, const SimulationOptions& second)
    : plan_(compile(scene)), first_(on(scene, first)), second_(on(scene, second)) {
    if (scene.colliders.empty()) return;
    const Scene touching = everySubstep(scene);
    const Plan plan = compile(touching);
    const bool implicit = std::any_of(plan.groups.begin(), plan.groups.end(), [](const GroupPlan& group) {
        return shoal::solver(group.solver).implicit;
    });
    const SimulationOptions options{.path = implicit ? first.path : Path::pingPong};
    touching_.emplace(testContext(), plan, options);
    free_.emplace(testContext(), compile(withoutColliders(touching)), options);
}

Comparison Agreement::at(int frame) {
    run(first_, frame - first_.frames());
    const SavedState saved = first_.save();
    const auto after = [&](Simulation& other) {
        other.load(saved);
        other.frame();
        return other.save();
    };
    after(second_);
    const SavedState touching = touching_ ? after(*touching_) : saved, free = free_ ? after(*free_) : saved;
    first_.frame();
    Comparison out;
    for (size_t g = 0; g < plan_.groups.size(); ++g)
        compareGroup(plan_.groups[g], saved.groups[g], first_.snapshot(g), second_.snapshot(g),
                     touching.groups[g], free.groups[g], first_.parameters.frameTime, out);
    return out;
}

bool takes(const Plan& plan, Path path) {
    try {
        choosePath(plan, path, limitsOf(testContext().info()));
        return true;
    } catch (const Error&) {
        return false;
    }
}

bool canFuse() {
    if (testContext().info().computeShaders) return true;
    WARN("skipped: the fused path needs OpenGL 4.3");
    return false;
}

}  // namespace shoal::test
