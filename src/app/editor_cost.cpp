#include "app/editor_cost.h"

#include <algorithm>
#include <chrono>
#include <vector>

#include "app/data_paths.h"
#include "gpu/gl.h"

namespace shoal::app {

MoleculeCost measureCost(gpu::Context& context, gpu::ProgramCache& cache, const Molecule& molecule,
                         const StageSettings& settings, int count) {
    Scene scene;
    scene.gravity = {0, -settings.gravity, 0};
    scene.solver.substeps = settings.substeps;
    scene.solver.kind = settings.solver;
    GustField gust;
    gust.speed = gust.frontSpeed = settings.wind;
    Field field;
    field.shape = gust;
    scene.fields.push_back(field);
    Group group;
    group.molecule = molecule;
    group.count = count;
    group.held = settings.pinsHold;
    group.drag = {settings.drag, molecule.triangles.empty() ? settings.drag : settings.drag / 5};
    group.place.kind = Placement::Kind::volume;
    group.place.box = {glm::dvec3(-50), glm::dvec3(50)};
    scene.groups.push_back(group);

    SimulationOptions options;
    options.drawn = false;
    options.cache = &cache;
    Simulation simulation(context, shaderRoot(), compile(scene), options);
    const auto frame = [&] {
        const auto begin = std::chrono::steady_clock::now();
        simulation.frame();
        glFinish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    frame();
    std::vector<double> times;
    double sum = 0;
    while (times.size() < 5 || (sum < 0.1 && times.size() < 200)) {
        times.push_back(frame());
        sum += times.back();
    }
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(times.size() / 2), times.end());
    return {times[times.size() / 2] / count, count, context.info().renderer};
}

}  // namespace shoal::app
