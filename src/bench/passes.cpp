#include "bench/bench.h"

#include <algorithm>

#include "gpu/gl.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

constexpr int leastRounds = 3, mostRounds = 15;

struct Run {
    PassTable table;
    std::unique_ptr<Simulation> simulation;
    std::vector<double> frames;  // s
};

void frame(Run& run) {
    glFinish();
    run.frames.push_back(measure::secondsOf([&] {
        run.simulation->frame();
        glFinish();
    }));
}

Run makeRun(const PassTable& table, const BenchMolecules& molecules, const BenchDevice& device) {
    BenchCase like;
    like.molecule = "quad";
    like.count = table.count;
    like.solver = table.solver;
    Plan plan = compile(benchScene(like, molecules.quad));
    plan.groups[0].start = BenchStart(like, molecules.quad, device.cores).packed;
    const SimulationOptions options{.timing = gpu::PassTimers::suitedTo(device.context->info()),
                                    .path = pathOf(table.subject)};
    Run out{table, std::make_unique<Simulation>(*device.context, std::move(plan), options), {}};
    frame(out);  // compiles and warms up
    out.simulation->timers().drain();
    out.simulation->timers().reset();
    out.frames.clear();
    return out;
}

}  // namespace

std::vector<PassTable> measurePasses(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                     double seconds, const BenchProgress& progress) {
    std::vector<int> counts = {1024, 16384, 131072};
    if (quick) counts.pop_back();
    std::vector<Run> runs;
    for (const int count : counts)
        for (const Subject subject : {Subject::fused, Subject::fragments, Subject::pingPong})
            for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog})
                if (!needsCompute(subject) || device.context->info().computeShaders)
                    runs.push_back(makeRun({count, subject, solver, {}, {}}, molecules, device));
    measure::pinRasteriserThreads();
    const Clock::time_point start = Clock::now();
    for (int round = 0; round < mostRounds; ++round) {
        const double spent = secondsSince(start);
        if (round >= leastRounds && spent > seconds) break;
        progress(std::min(1.0, std::max(spent / seconds, double(round) / mostRounds)));
        for (Run& run : runs)
            frame(run);
    }
    std::vector<PassTable> out;
    for (Run& run : runs) {
        run.simulation->timers().drain();
        run.table.passes = run.simulation->timers().report();
        run.table.frame = measure::spreadOf(run.frames);
        out.push_back(std::move(run.table));
    }
    return out;
}

}  // namespace shoal::bench
