// What the ping-pong path costs: time per pass and frame for quads in uniform wind above a plane, 4 substeps.
// Sizes are measured in turn, round after round, so that a machine whose speed drifts drifts for all alike;
// minimum and median are reported. Figures and how to read them: docs/performance.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "gpu/gl.h"
#include "molecule/molecule_file.h"
#include "measure/pin_threads.h"
#include "reference/solve.h"
#include "simulate/simulation.h"

using namespace shoal;

namespace {

Scene quads(int count, SolverKind solver) {
    Scene scene;
    scene.name = "quads";
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = solver;
    scene.solver.substeps = 4;
    scene.fields.emplace_back().shape = UniformField{{2, 0, 0.5}};
    scene.colliders.emplace_back();  // a plane, y = 0
    Group group;
    group.name = "quads";
    group.molecule = readMolecule(SHOAL_SOURCE_DIR "/molecules/quad.json");
    group.count = count;
    group.place.box = {{-20, 0.2, -20}, {20, 6, 20}};
    group.place.turn = Placement::Turn::any;
    group.drag = {1, 1};
    scene.groups.push_back(group);
    return scene;
}

struct Measured {
    int count;
    const char* solver;
    std::unique_ptr<Simulation> simulation;
    std::vector<double> frames;  // s, whole frames, with the waits between passes that timing them takes
};

// RMS relative error of 64 of the quads after 1 s with the benchmark's step, against the double-precision
// reference: the same forces, in the air, with a spin that makes the springs work.
double errorOf(gpu::Context& context, SolverKind solver) {
    Scene scene = quads(64, solver);
    scene.colliders.clear();
    Group& group = scene.groups[0];
    group.spin = {3, -4, 2};
    Simulation simulation(context, SHOAL_SOURCE_DIR "/shaders", compile(scene),
                          {.drawn = false, .path = Path::pingPong});
    const Snapshot start = simulation.snapshot(0);
    for (int i = 0; i < 60; ++i)
        simulation.frame();
    const Snapshot end = simulation.snapshot(0);
    reference::Problem problem;
    problem.molecule = &group.molecule;
    problem.gravity = scene.gravity;
    problem.drag = group.drag;
    problem.fields = scene.fields;
    const auto stateOf = [](const Snapshot& snapshot, int m) {
        const auto first = ptrdiff_t(m) * snapshot.vertexCount, last = first + snapshot.vertexCount;
        return reference::State{snapshot.time,
                                {snapshot.positions.begin() + first, snapshot.positions.begin() + last},
                                {snapshot.velocities.begin() + first, snapshot.velocities.begin() + last}};
    };
    double sum = 0;
    for (int m = 0; m < start.count; ++m) {
        const reference::Solution exact = reference::solve(problem, stateOf(start, m), 1, 1e-7);
        if (!exact.converged) throw Error("the reference does not converge");
        const double error = reference::relativeError(stateOf(end, m), exact.state, group.molecule.size());
        sum += error * error / start.count;
    }
    return std::sqrt(sum);
}

double middle(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

void printTable(Measured& run) {
    std::printf("\n%d quads, %s, 4 substeps\n", run.count, run.solver);
    std::printf("  %-9s %6s %12s %12s %16s\n", "pass", "calls", "min ms", "median ms", "ns/vertex/call");
    for (const gpu::PassTime& pass : run.simulation->timers().report())
        std::printf("  %-9s %6d %12.3f %12.3f %16.1f\n", pass.name.c_str(), pass.calls, pass.min * 1e3,
                    pass.median * 1e3, pass.median * 1e9 / pass.calls / (4.0 * run.count));
    std::printf("  %-9s %6s %12.3f %12.3f %16.1f\n", "frame", "",
                *std::min_element(run.frames.begin(), run.frames.end()) * 1e3, middle(run.frames) * 1e3,
                middle(run.frames) * 1e9 / (4.0 * run.count));
}

}  // namespace

// Arguments: the number of rounds (default 15); --context egl|osmesa.
static int measureAll(int argc, char** argv) {
    int rounds = 15;
    gpu::ContextOptions options;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--context") == 0 && i + 1 < argc)
            options.kind = gpu::contextKind(argv[++i]);
        else
            rounds = std::max(3, std::atoi(argv[i]));
    }
    gpu::Context context(options);
    const int pinned = measure::pinRasteriserThreads();
    std::printf("%s, OpenGL %s\n%d rounds, sizes in turn; %d rasteriser threads pinned\n",
                context.info().renderer.c_str(), context.info().version.c_str(), rounds, pinned);
    for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog})
        std::printf("%s: relative error %.2e after 1 s at this step, in the air\n", name(solver),
                    errorOf(context, solver));
    std::vector<Measured> runs;
    for (const int count : {1000, 16000, 131000})
        for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog})
            runs.push_back(
                {count,
                 name(solver),
                 std::make_unique<Simulation>(
                     context, SHOAL_SOURCE_DIR "/shaders", compile(quads(count, solver)),
                     SimulationOptions{.timing = gpu::PassTimers::Mode::finish, .path = Path::pingPong}),
                 {}});
    for (int round = -1; round < rounds; ++round) {
        for (Measured& run : runs) {
            glFinish();
            const auto start = std::chrono::steady_clock::now();
            run.simulation->frame();
            glFinish();
            const double seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            if (round < 0) run.simulation->timers().reset();  // the first frame compiles and warms up
            if (round >= 0) run.frames.push_back(seconds);
        }
        std::fprintf(stderr, "round %d of %d\n", round + 1, rounds);
    }
    for (Measured& run : runs)
        printTable(run);
    return 0;
}

int main(int argc, char** argv) {
    try {
        return measureAll(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "shoal-performance: %s\n", error.what());
        return 1;
    }
}
