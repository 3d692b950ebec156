#include "app/molecule/molecule_report.h"

#include <algorithm>
#include <cmath>

#include "app/line/commands.h"
#include "core/error.h"
#include "molecule/analysis.h"
#include "scene/known_colliders.h"
#include "simulate/simulation.h"

namespace shoal::app {

static Scene sceneOf(const Molecule& molecule) {
    double lowest = INFINITY;
    for (const Vertex& vertex : molecule.vertices)
        lowest = std::min(lowest, vertex.position.y);
    Scene scene;
    scene.gravity = {0, -9.81, 0};
    Group group;
    group.name = molecule.name;
    group.molecule = molecule;
    group.count = 1;
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    group.place.items.push_back({});
    scene.groups.push_back(std::move(group));
    Collider floor;
    floor.name = "floor";
    floor.shape = PlaneCollider{{0, lowest - molecule.size() / 2, 0}, {0, 1, 0}};
    scene.colliders.push_back(floor);
    return scene;
}

// With the substeps of a scene that says nothing or, where the solver asks for more, with those.
static Plan planOf(Scene& scene) {
    try {
        return compile(scene);
    } catch (const Error&) {
        const double stable = analyse(scene.groups[0].molecule, false).stableStepLeapfrog;
        const double needed = std::ceil(1.02 / scene.frameRate / stable);
        if (!(needed > scene.solver.substeps && needed <= maxSubsteps)) throw;
        scene.solver.substeps = int(needed);
        return compile(scene);
    }
}

Trial tryOut(const Molecule& molecule, const Options& options) {
    Trial out;
    Scene scene = sceneOf(molecule);
    Plan plan = planOf(scene);
    out.substeps = scene.solver.substeps;
    out.solver = name(plan.groups[0].solver);
    std::optional<gpu::Context> context;
    try {
        context.emplace(hiddenContext(options));
    } catch (const Error& error) {
        out.untried = error.message();
        return out;
    }
    SimulationOptions simulationOptions;
    simulationOptions.drawn = false;
    Simulation simulation(*context, std::move(plan), simulationOptions);
    for (int frame = 0; frame < Trial::frames; ++frame) {
        simulation.frame();
        if (frame % 4 != 3) continue;
        simulation.check();
        const Snapshot state = simulation.snapshot(0);
        for (const Spring& spring : molecule.springs) {
            const double rest = molecule.restLength(spring);
            const double length =
                glm::distance(state.positions[size_t(spring.a)], state.positions[size_t(spring.b)]);
            if (rest > 0) out.change = std::max(out.change, std::abs(length / rest - 1));
        }
        out.speed = 0;
        for (const glm::dvec3& velocity : state.velocities)
            out.speed = std::max(out.speed, glm::length(velocity));
    }
    return out;
}

}  // namespace shoal::app
