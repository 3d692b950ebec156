#include "bench/bench.h"

#include <stdlib.h>

#include <filesystem>
#include <random>

#include "gpu/gl.h"
#include "gpu/program_cache.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

class ScratchFolder {
  public:
    ScratchFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "shoal-bench-XXXXXX").string();
        if (!::mkdtemp(pattern.data())) throw Error(concat("cannot make a folder such as ", pattern));
        path = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path path;
};

// `folder`: of linked programs.
double firstFrame(const Plan& plan, const BenchDevice& device, const std::string& folder) {
    const gpu::OtherCache kept(*device.context, folder);
    const SimulationOptions options{.drawn = false, .path = Path::fused};
    Plan own = plan;
    glFinish();
    const Clock::time_point start = Clock::now();
    Simulation simulation(*device.context, std::move(own), options);
    simulation.frame();
    glFinish();
    return secondsSince(start);
}

// A molecule of a slightly different shape, which no cache has seen: its rest lengths are the kernel's
// constants.
Molecule unseen(const Molecule& molecule) {
    std::random_device random;
    const double share = 1 + 1e-3 * double(random()) / double(std::random_device::max());
    Molecule out = molecule;
    for (Vertex& vertex : out.vertices)
        vertex.position *= share;
    return out;
}

}  // namespace

std::vector<StartTime> measureStart(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                    const BenchProgress& progress) {
    std::vector<StartTime> out;
    if (!device.context->info().computeShaders) return out;
    for (const char* molecule : {"quad", "cross", "fish"})
        for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog})
            if (!quick || solver == SolverKind::euler) out.push_back({molecule, solver, 16384});
    for (size_t i = 0; i < out.size(); ++i) {
        progress(double(i) / double(out.size()));
        StartTime& times = out[i];
        BenchCase like;
        like.molecule = times.molecule;
        like.count = times.count;
        like.solver = times.solver;
        const Scene scene = benchScene(like, unseen(molecules.named(times.molecule)));
        const Clock::time_point start = Clock::now();
        const Plan plan = compile(scene);
        times.compile = secondsSince(start);
        const ScratchFolder folder;
        times.cold = firstFrame(plan, device, folder.path.string());
        times.driver = firstFrame(plan, device, "");
        times.cached = firstFrame(plan, device, folder.path.string());
    }
    return out;
}

}  // namespace shoal::bench
