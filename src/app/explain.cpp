#include <iostream>

#include "app/commands.h"
#include "core/json.h"
#include "scene/scene_file.h"

namespace shoal::app {

Loaded load(const Options& options, const PlanLimits& limits) {
    Loaded out{readScene(options.files.front()), {}};
    apply(options, out.scene);
    out.plan = compile(out.scene, limits);
    for (const Warning& warning : out.plan.warnings)
        std::cerr << "shoal: warning: " << text(warning) << "\n";
    return out;
}

int explainCommand(const Options& options) {
    const Loaded loaded = load(options, {});
    std::cout << (options.json ? writeJson(explainJson(loaded.plan)) : explain(loaded.plan));
    return 0;
}

}  // namespace shoal::app
