#include "run/request.h"

#include <algorithm>

#include "run/progress.h"
#include "scene/json/scene_file.h"

namespace shoal {

void apply(const RunRequest& request, Scene& scene) {
    if (request.dt) scene.frameRate = 1 / *request.dt;
    if (request.solver) scene.solver.kind = *request.solver;
    if (request.sampling) scene.solver.fieldSampling = *request.sampling;
    if (request.substeps) scene.solver.substeps = *request.substeps;
    if (request.seed) scene.seed = *request.seed;
    if (!request.count) return;
    for (Group& group : scene.groups) {
        const bool counted =
            group.place.kind == Placement::Kind::grid || group.place.kind == Placement::Kind::list;
        const bool startsEmpty = group.life && group.count == 0;
        if (!counted && !startsEmpty) group.count = *request.count;
        if (group.life) group.life->capacity = std::max(*request.count, group.count);
    }
}

Scene readScene(const std::string& file, const RunRequest& request) {
    FieldWatch watch;
    Scene out = readScene(file, watch.baking(), request.lenient);
    apply(request, out);
    checkCounts(out);
    return out;
}

void planScene(Loaded& loaded) {
    loaded.plan = compile(loaded.scene);
    tellWarnings(loaded.plan.warnings);
}

Loaded loadScene(const std::string& file, const RunRequest& request) {
    Loaded out{readScene(file, request), {}};
    planScene(out);
    return out;
}

}  // namespace shoal
