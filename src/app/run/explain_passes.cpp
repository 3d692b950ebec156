#include "app/run/explain.h"

#include "core/printable.h"
#include "render/renderer.h"
#include "simulate/simulation.h"

namespace shoal::app {

namespace {

std::string listed(const char* verb, const std::vector<std::string>& names) {
    std::string out = names.empty() ? "" : concat("  ", verb);
    for (const std::string& name : names)
        out += concat(" ", name);
    return out;
}

JsonValue asJson(const gpu::PassRow& row) {
    return object(key("stage", row.stage), key("pass", row.pass), key("times", row.times),
                  key("reads", row.reads), key("writes", row.writes));
}

}  // namespace

FramePasses framePasses(const Options& options, const Loaded& loaded) {
    gpu::Context context(hiddenContext(options));
    SimulationOptions simulationOptions;
    simulationOptions.path = options.path;
    simulationOptions.lanes = options.lanes;
    simulationOptions.inPlace = options.inPlace;
    Simulation simulation(context, loaded.plan, simulationOptions);
    // A small one: its size changes at most with how many triangles a far skin is drawn.
    Renderer renderer(context, loaded.scene, simulation.plan(), {.width = 320, .height = 180});
    const auto frame = [&] {
        simulation.frame();
        renderer.draw(simulation.state(), View::fromCamera(loaded.scene.camera, simulation.time()));
    };
    frame();
    const gpu::FrameRecord record;
    frame();
    context.checkErrors("--passes");
    return {bench::measuredOn(context, SHOAL_VERSION), record.rows()};
}

std::string asText(const FramePasses& passes) {
    std::string out =
        asText(passes.machine) +
        "\n\na frame and its picture, by the stages of run --timings: each pass, how often, and what it "
        "reads and writes\n";
    std::string stage;
    for (const gpu::PassRow& row : passes.rows) {
        if (row.stage != stage) out += concat(row.stage, "\n");
        stage = row.stage;
        out += concat(formatted("  %5d x ", row.times), printable(row.pass), "\n");
        const std::string uses = listed("reads", row.reads) + listed("writes", row.writes);
        if (!uses.empty()) out += concat("         ", uses, "\n");
    }
    return out;
}

JsonValue asJson(const FramePasses& passes) {
    return object(key("renderer", passes.machine.context.renderer),
                  key("passes", arrayOf<gpu::PassRow>(passes.rows, asJson)));
}

}  // namespace shoal::app
