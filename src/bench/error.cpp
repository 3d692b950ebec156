#include "bench/bench.h"

#include <cmath>

#include "core/parallel.h"
#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"
#include "reference/solve.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using measure::ExactEnds;

constexpr double duration = 1;      // s
constexpr double tolerance = 1e-7;  // of the reference

std::vector<BenchError> errorCases() {
    std::vector<BenchError> out;
    for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog}) {
        for (const Wind wind : {Wind::uniform, Wind::gusts}) {
            out.push_back({Subject::pingPong, solver, wind, FieldSampling::vertexSubstep, {}});
            for (const FieldSampling sampling : measure::allSamplings) {
                // reading a uniform wind less often changes nothing
                if (wind == Wind::uniform && sampling != FieldSampling::vertexSubstep) continue;
                out.push_back({Subject::fused, solver, wind, sampling, {}});
            }
        }
    }
    return out;
}

Scene inTheAir(const BenchError& error, const Molecule& molecule, int count) {
    BenchCase benchCase;
    benchCase.molecule = molecule.name;
    benchCase.count = count;
    benchCase.solver = error.solver;
    benchCase.wind = error.wind;
    benchCase.sampling = error.sampling;
    Scene scene = benchScene(benchCase, molecule);
    scene.colliders.clear();
    scene.groups[0].spin = {3, -4, 2};  // makes the springs work
    return scene;
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
    parallel(start.count, cores, [&](int m) {
        const reference::Solution solution =
            reference::solve(problem, ExactEnds::stateOf(start, m), duration, tolerance);
        if (solution.converged) out[size_t(m)] = solution.state;
    });
    return out;
}

std::optional<double> rms(const Snapshot& end, const Exact& exact, double size) {
    double sum = 0;
    for (int m = 0; m < end.count; ++m) {
        if (!exact[size_t(m)]) return std::nullopt;
        const double error = reference::relativeError(ExactEnds::stateOf(end, m), *exact[size_t(m)], size);
        sum += error * error / end.count;
    }
    return std::sqrt(sum);
}

}  // namespace

std::vector<BenchError> measureErrors(const BenchMolecules& molecules, const BenchDevice& device, int count,
                                      const BenchProgress& progress) {
    std::vector<BenchError> out = errorCases();
    std::optional<Exact> exact[2];
    for (size_t i = 0; i < out.size(); ++i) {
        progress(double(i) / double(out.size()));
        BenchError& error = out[i];
        if (needsCompute(error.subject) && !device.context->info().computeShaders) continue;
        const Scene scene = inTheAir(error, molecules.quad, count);
        const SimulationOptions options{.drawn = false, .path = pathOf(error.subject)};
        Simulation simulation(*device.context, compile(scene), options);
        std::optional<Exact>& solution = exact[size_t(error.wind)];
        if (!solution) solution = solveAll(scene, simulation.snapshot(0), device.cores);
        for (int frame = 0; frame < int(std::lround(duration * scene.frameRate)); ++frame)
            simulation.frame();
        error.relative = rms(simulation.snapshot(0), *solution, molecules.quad.size());
    }
    return out;
}

}  // namespace shoal::bench
