#include <iostream>

#include "app/line/commands.h"
#include "app/measure/measure.h"
#include "app/run/explain.h"
#include "core/data_paths.h"
#include "core/json.h"
#include "simulate/fused_kernel.h"

namespace shoal::app {

// Explains for the default limits of a context (PathLimits), without asking a driver. Only --error, --cost
// and --passes make a context, to measure on it.
int explainCommand(const Options& options) {
    Loaded loaded = load(options);
    std::optional<measure::Calibration> found;
    if (options.error) {
        gpu::Context context(hiddenContext(options));
        found = calibrated(options, context, loaded);
    }
    std::optional<SceneCost> cost;
    if (options.cost) cost = sceneCost(options, loaded);
    std::optional<FramePasses> passes;
    if (options.passes) passes = framePasses(options, loaded);
    const PathLimits limits;
    const PathChoice choice = choosePath(loaded.plan, options.path, limits, options.lanes);
    if (options.shader && choice.path == Path::pingPong)
        throw WrongUse("--shader prints the fused path's kernels; this scene runs on the other path: " +
                       choice.why);
    if (options.json) {
        JsonValue report = explainJson(loaded.plan, choice, options.inPlace);
        if (found) report.add("calibration", asJson(*found));
        if (cost) report.add("cost", asJson(*cost));
        if (passes) report.add("frame", asJson(*passes));
        std::cout << writeJson(report);
        return 0;
    }
    if (!options.shader) {
        std::cout << explain(loaded.plan, choice, options.inPlace);
        if (found) std::cout << "\n" << asText(*found);
        if (cost) std::cout << "\n" << asText(*cost);
        if (passes) std::cout << "\n" << asText(*passes);
        return 0;
    }
    std::string shaders =
        "// As a GPU gets it. A CPU rasteriser keeps more molecules in a lane (--lanes molecule), and stores "
        "and\n// reads uniforms in its own way.\n";
    for (size_t g = 0; g < loaded.plan.groups.size(); ++g) {
        KernelOptions kernel;
        kernel.watch = true;
        if (choice.path == Path::fragments) {
            kernel.targets = limits.targets;
        } else {
            kernel.lanes = chooseLanes(loaded.plan, loaded.plan.groups[g], options.lanes, limits);
            kernel.normals = true;
        }
        shaders += kernelShader(shaderRoot(), loaded.plan, g, kernel) + "\n";
    }
    std::cout << shaders;
    return 0;
}

}  // namespace shoal::app
