#include <algorithm>
#include <cmath>
#include <thread>

#include "core/activity.h"
#include "core/error.h"
#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"
#include "window/panel.h"

namespace shoal::window {

using namespace measure;

namespace {

constexpr int molecules = 4;      // of each group
constexpr double duration = 0.5;  // s
constexpr double secondsAMolecule = 0.5;

}  // namespace

std::string methodError(const Scene& scene, const Simulation& simulation) {
    const Plan& plan = simulation.plan();
    const Activity measuring("measuring the error");
    const AccuracyDevice device{.context = &simulation.context(),
                                .cores = int(std::max(1u, std::thread::hardware_concurrency())),
                                .path = simulation.path().path};
    try {
        requireReference(scene);
        const Scene few = withMolecules(scene, molecules);
        MethodRunner runner(few, {plan.groups.front().solver, plan.fieldSampling}, device);
        const Step step{simulation.parameters.substeps, 1};
        const std::string refusal = runner.refusal(step);
        if (!refusal.empty()) return "no error: " + refusal;
        runner.set(step);
        runner.restart();
        const int frames = std::max(1, int(std::lround(duration * scene.frameRate)));
        ExactEnds ends(few, runner.simulation().plan(), runner.snapshots(), frames / scene.frameRate,
                       device.cores, molecules);
        const Settled settled = ends.solve(1e-6, secondsAMolecule);
        if (settled == Settled::chaotic) return "no error: the motion is chaotic";
        if (settled == Settled::tooStiff) return "no error: too stiff for a reference in time";
        runner.run(frames);
        const std::vector<Snapshot> reached = runner.snapshots();
        if (!ExactEnds::finite(reached)) return "it blows up";
        return formatted("error %.1e of its size (RMS of %d after %.2g s)",
                         std::max(ends.errorOf(reached).total, ends.error()), ends.molecules(),
                         frames / scene.frameRate);
    } catch (const Error& error) {
        return concat("no error: ", error.message());
    }
}

}  // namespace shoal::window
