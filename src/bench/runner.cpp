#include "bench/runner.h"

#include <cstring>

#include "bench/baseline_threads.h"
#include "compile/cost.h"
#include "compile/pack.h"
#include "gpu/buffer.h"
#include "gpu/gl.h"
#include "gpu/program.h"
#include "simulate/simulation.h"

namespace shoal::bench {

using glm::vec3;

namespace {

class PathRunner : public BenchRunner {
  public:
    PathRunner(const BenchCase& benchCase, const Molecule& molecule, const BenchStart& start,
               const BenchDevice& device)
        : scene_(benchScene(benchCase, molecule)),
          simulation_(*device.context, planOf(start), optionsOf(benchCase)) {
        if (benchCase.drawn) draw_ = device.makeDraw(scene_, simulation_.plan());
        stateBytes = simulation_.stateBytes();
        lanes = simulation_.lanes(0);
        operations = benchCase.drawn ? 0 : operationsPerFrame(benchCase, molecule);
        if (benchCase.subject == Subject::fused)
            movedBytes = fusedBytesPerFrame(simulation_.plan(), benchCase.drawn);
    }
    void restart() override { simulation_.restart(); }
    void frame() override {
        simulation_.frame();
        if (draw_) draw_(simulation_.state());
    }
    void finish() override { glFinish(); }

  private:
    Plan planOf(const BenchStart& start) const {
        Plan out = compile(scene_);
        out.groups[0].start = start.packed;
        return out;
    }
    static SimulationOptions optionsOf(const BenchCase& benchCase) {
        return {.drawn = benchCase.drawn,
                .path = pathOf(benchCase.subject),
                .inPlace = benchCase.inPlace,
                .lanes = benchCase.lanes};
    }

    Scene scene_;
    Simulation simulation_;
    Draw draw_;
};

class BaselineRunner : public BenchRunner {
  public:
    BaselineRunner(const BenchCase& benchCase, const Molecule& molecule, const BenchStart& start, int cores)
        : start_(start),
          step_(baselineStep(benchScene(benchCase, molecule))),
          baseline_(molecule, benchCase.count, simdOf(benchCase.subject), cores) {
        stateBytes = baseline_.bytesPerMolecule() * size_t(benchCase.count);
        movedBytes = 2 * stateBytes;
        operations = operationsPerFrame(benchCase, molecule);
        restart();
    }
    void restart() override { baseline_.set(start_.positions, start_.velocities); }
    void frame() override { baseline_.frame(step_); }

  private:
    const BenchStart& start_;
    BaselineStep step_;
    Baseline baseline_;
};

// One side of the state into the other, there and back.
class BufferCopy : public BenchRunner {
  public:
    BufferCopy(size_t bytes, const BenchDevice& device) {
        const std::vector<std::byte> zeros(bytes);
        for (gpu::Buffer& side : sides_)
            side = gpu::Buffer(*device.context, gpu::Buffer::Use::storage, zeros.data(), bytes, "copy");
        stateBytes = movedBytes = 2 * bytes;
    }
    void frame() override {
        sides_[current_].copyTo(sides_[1 - current_], sides_[0].bytes());
        current_ = 1 - current_;
    }
    void finish() override { glFinish(); }

  protected:
    gpu::Buffer sides_[2];
    size_t current_ = 0;
};

class KernelCopy : public BufferCopy {
  public:
    KernelCopy(size_t bytes, const BenchDevice& device) : BufferCopy(bytes, device) {
        gpu::ProgramOptions options;
        options.compute = "bench/copy.comp";
        options.label = "copy";
        options.defines = {concat("LANES ", lanesOfGroup)};
        if (device.context->info().software) options.defines.emplace_back("SOFTWARE");
        program_ = gpu::Program(*device.context, options);
        for (size_t i = 0; i < 2; ++i)
            textures_[i] = gpu::BufferTexture(*device.context, sides_[i], "copy");
    }
    void frame() override {
        const int elements = int(sides_[0].bytes() / sizeof(glm::vec4));
        program_.use();
        program_.texture("source", textures_[current_]);
        current_ = 1 - current_;
        program_.storage("Target", sides_[current_], 0, sides_[0].bytes());
        program_.set("elements", elements);
        program_.dispatch((elements + lanesOfGroup - 1) / lanesOfGroup);
        gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
    }

    static constexpr int lanesOfGroup = 128;

  private:
    gpu::Program program_;
    gpu::BufferTexture textures_[2];
};

class MultiplyAdd : public BenchRunner {
  public:
    explicit MultiplyAdd(const BenchDevice& device) {
        gpu::ProgramOptions options;
        options.compute = "bench/multiply_add.comp";
        options.label = "multiply-adds";
        options.defines = {concat("LANES ", lanesOfGroup), concat("ROUNDS ", rounds)};
        program_ = gpu::Program(*device.context, options);
        result_ = gpu::Buffer(*device.context, gpu::Buffer::Use::storage, nullptr,
                              size_t(groups * lanesOfGroup) * sizeof(float), "multiply-adds");
        operations = 16.0 * rounds * groups * lanesOfGroup;
    }
    void frame() override {
        program_.use();
        program_.set("factor", glm::vec4(0.999f, 0.998f, 0.997f, 0.996f));
        program_.set("addend", glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
        program_.storage("Result", result_, 0, result_.bytes());
        program_.dispatch(groups);
        gpu::barrier({gpu::Barrier::storage});
    }
    void finish() override { glFinish(); }

  private:
    static constexpr int lanesOfGroup = 128, groups = 2048, rounds = 1024;
    gpu::Program program_;
    gpu::Buffer result_;
};

class MemoryCopy : public BenchRunner {
  public:
    MemoryCopy(size_t bytes, int cores) : threads_(cores), from_(bytes, 'x'), to_(bytes, 'y') {
        stateBytes = movedBytes = 2 * bytes;
    }
    void frame() override {
        threads_.run([&](int index) {
            const auto [first, last] = threads_.part(from_.size(), index);
            std::memcpy(to_.data() + first, from_.data() + first, last - first);
        });
        std::swap(from_, to_);
    }

  private:
    PinnedThreads threads_;
    std::vector<char> from_, to_;
};

// Returns the bytes of one side of the fused path's state.
size_t sideBytes(const BenchCase& benchCase, const Molecule& molecule) {
    const BufferLayout layout{int(molecule.vertices.size())};
    return layout.padded(size_t(benchCase.count)) * size_t(layout.stateElements()) * sizeof(glm::vec4);
}

}  // namespace

BenchStart::BenchStart(const BenchCase& benchCase, const Molecule& molecule, int cores) {
    BenchCase plain = benchCase;
    plain.wind = Wind::uniform;
    const Scene scene = benchScene(plain, molecule);
    packed = compile(scene).groups[0].start;
    const size_t vertices = molecule.vertices.size();
    for (size_t i = 0; i < packed.positions.size(); ++i)
        positions.push_back(packed.anchors[i / vertices] + packed.positions[i]);
    velocities = packed.velocities;
    Baseline baseline(molecule, benchCase.count, bestSimd(), cores);
    baseline.set(positions, velocities);
    const BaselineStep step = baselineStep(scene);
    for (int i = 0; i < framesBefore; ++i)
        baseline.frame(step);
    baseline.get(positions, velocities);
    packed.velocities = velocities;
    for (size_t m = 0; m < packed.anchors.size(); ++m) {
        packed.anchors[m] = latticePoint(positions[m * vertices]);
        for (size_t i = m * vertices; i < (m + 1) * vertices; ++i)
            packed.positions[i] = positions[i] - packed.anchors[m];
    }
}

double lastOf(const gpu::PassTimers& timers, const char* pass) {
    for (const gpu::PassTime& time : timers.report())
        if (time.name == pass) return time.last;
    return 0;
}

size_t fusedBytesPerFrame(const Plan& plan, bool drawn) {
    size_t out = 0;
    for (const GroupPlan& group : plan.groups)
        out += size_t(group.count) * bytesPerMolecule(group, drawn);
    return out;
}

double operationsPerFrame(const BenchCase& benchCase, const Molecule& molecule) {
    if (benchCase.solver != SolverKind::euler || benchCase.wind != Wind::uniform) return 0;
    const double substep = springOperations * double(molecule.springs.size()) +
                           (motionOperations + planeOperations) * double(molecule.vertices.size());
    return substep * benchCase.substeps * benchCase.count;
}

std::string reasonToLeaveOut(const BenchCase& benchCase, const Molecule& molecule,
                             const BenchDevice& device) {
    const gpu::ContextInfo& info = device.context->info();
    if (needsCompute(benchCase.subject) && !info.computeShaders)
        return concat("needs OpenGL 4.3; this context has ", info.major, ".", info.minor);
    if (isBaseline(benchCase.subject) && !available(simdOf(benchCase.subject)))
        return "this processor or build lacks the instructions";
    if (benchCase.drawn && !device.makeDraw) return "nothing to draw with";
    const auto bytes = int64_t(sideBytes(benchCase, molecule));
    const int64_t texels = bytes / int64_t(sizeof(glm::vec4));
    const bool fits = bytes <= info.maxStorageBlockBytes && texels <= info.maxBufferTexels &&
                      texels / KernelCopy::lanesOfGroup < info.maxWorkGroupsX;
    if (benchCase.subject == Subject::kernelCopy && !fits) return "more than one dispatch can copy here";
    return {};
}

std::unique_ptr<BenchRunner> makeRunner(const BenchCase& benchCase, const Molecule& molecule,
                                        const BenchStart& start, const BenchDevice& device) {
    if (isPath(benchCase.subject)) return std::make_unique<PathRunner>(benchCase, molecule, start, device);
    if (isBaseline(benchCase.subject))
        return std::make_unique<BaselineRunner>(benchCase, molecule, start, device.cores);
    if (benchCase.subject == Subject::memoryCopy) {
        const size_t bytes = (6 * molecule.vertices.size() + 3) * sizeof(float) * size_t(benchCase.count);
        return std::make_unique<MemoryCopy>(bytes, device.cores);
    }
    if (benchCase.subject == Subject::multiplyAdd) return std::make_unique<MultiplyAdd>(device);
    const size_t bytes = sideBytes(benchCase, molecule);
    if (benchCase.subject == Subject::kernelCopy) return std::make_unique<KernelCopy>(bytes, device);
    return std::make_unique<BufferCopy>(bytes, device);
}

}  // namespace shoal::bench
