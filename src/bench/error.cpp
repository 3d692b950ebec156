#include "bench/bench.h"

#include <atomic>
#include <cmath>
#include <thread>

#include "reference/solve.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

constexpr double duration = 1;      // s
constexpr double tolerance = 1e-7;  // of the reference

std::vector<BenchError> errorCases() {
    std::vector<BenchError> out;
    for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog}) {
        for (const Wind wind : {Wind::uniform, Wind::gusts}) {
            out.push_back({Subject::pingPong, solver, wind, FieldSampling::vertexSubstep, {}});
            for (const FieldSampling sampling :
                 {FieldSampling::vertexSubstep, FieldSampling::vertexFrame, FieldSampling::moleculeFrame}) {
                // reading a uniform wind less often changes nothing
                if (wind == Wind::uniform && sampling != FieldSampling::vertexSubstep) continue;
                out.push_back({Subject::fused, solver, wind, sampling, {}});
            }
        }
    }
    return out;
}

Scene inTheAir(const BenchError& error, const Molecule& molecule, int count) {
    BenchCase one;
    one.molecule = molecule.name;
    one.count = count;
    one.solver = error.solver;
    one.wind = error.wind;
    one.sampling = error.sampling;
    Scene scene = benchScene(one, molecule);
    scene.colliders.clear();
    scene.groups[0].spin = {3, -4, 2};  // makes the springs work
    return scene;
}

reference::State stateOf(const Snapshot& snapshot, int m) {
    const auto first = ptrdiff_t(m) * snapshot.vertexCount, last = first + snapshot.vertexCount;
    return {snapshot.time,
            {snapshot.positions.begin() + first, snapshot.positions.begin() + last},
            {snapshot.velocities.begin() + first, snapshot.velocities.begin() + last}};
}

// Where the molecules of one wind are at the end; empty where the reference does not converge.
using Exact = std::vector<std::optional<reference::State>>;

Exact solveAll(const Scene& scene, const Snapshot& start, int cores) {
    const Group& group = scene.groups[0];
    reference::Problem problem;
    problem.molecule = &group.molecule;
    problem.gravity = scene.gravity;
    problem.drag = group.drag;
    problem.fields = scene.fields;
    Exact out(size_t(start.count));
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int m = next++; m < start.count; m = next++) {
            const reference::Solution solution =
                reference::solve(problem, stateOf(start, m), duration, tolerance);
            if (solution.converged) out[size_t(m)] = solution.state;
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < cores; ++i)
        threads.emplace_back(work);
    work();
    for (std::thread& thread : threads)
        thread.join();
    return out;
}

std::optional<double> rms(const Snapshot& end, const Exact& exact, double size) {
    double sum = 0;
    for (int m = 0; m < end.count; ++m) {
        if (!exact[size_t(m)]) return std::nullopt;
        const double error = reference::relativeError(stateOf(end, m), *exact[size_t(m)], size);
        sum += error * error / end.count;
    }
    return std::sqrt(sum);
}

}  // namespace

std::vector<BenchError> measureErrors(const BenchMolecules& molecules, const BenchDevice& device, int count,
                                      const std::function<void(double share)>& progress) {
    std::vector<BenchError> out = errorCases();
    std::optional<Exact> exact[2];
    for (size_t i = 0; i < out.size(); ++i) {
        progress(double(i) / double(out.size()));
        BenchError& one = out[i];
        if (needsCompute(one.subject) && !device.context->info().computeShaders) continue;
        const Scene scene = inTheAir(one, molecules.quad, count);
        SimulationOptions options;
        options.drawn = false;
        options.path = one.subject == Subject::fused ? Path::fused : Path::pingPong;
        options.cache = device.cache;
        Simulation simulation(*device.context, device.shaderRoot, compile(scene), options);
        std::optional<Exact>& solution = exact[size_t(one.wind)];
        if (!solution) solution = solveAll(scene, simulation.snapshot(0), device.cores);
        for (int frame = 0; frame < int(std::lround(duration * scene.frameRate)); ++frame)
            simulation.frame();
        one.relative = rms(simulation.snapshot(0), *solution, molecules.quad.size());
    }
    return out;
}

}  // namespace shoal::bench
