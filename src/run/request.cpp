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

RunRequest RunRequest::forAnother() const {
    RunRequest out;
    out.path = path;
    out.lanes = lanes;
    out.inPlace = inPlace;
    out.lenient = lenient;
    return out;
}

Scene readScene(const std::string& file, const RunRequest& request, void (*check)(const Scene&)) {
    return readScene(file, {.lenient = request.lenient, .beforeBaking = [&](Scene& scene) {
                                apply(request, scene);
                                check(scene);
                            }});
}

void planScene(Loaded& loaded) {
    loaded.plan = compile(loaded.scene);
    tellWarnings(loaded.plan.warnings);
}

Loaded loadScene(const std::string& file, const RunRequest& request) {
    Loaded out{readScene(file, request, checkPlan), {}};
    planScene(out);
    return out;
}

}  // namespace shoal
