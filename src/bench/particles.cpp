#include "bench/particles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "bench/particle_baseline.h"
#include "bench/sort.h"
#include "gpu/gl.h"
#include "scene/field_kinds.h"
#include "simulate/contact/data.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using What = ParticleCase::What;

constexpr int framesBefore = 30, framesTimed = 8;
constexpr double slowFrameSeconds = 0.1;  // such frames are timed one by one

// Frames until as many die as are born.
int framesToSteady(const ParticleCase& particleCase) {
    return particleCase.turnover > 0 ? int(2 / particleCase.turnover) + 2 : framesBefore;
}

Simulation makeSimulation(const ParticleCase& particleCase, const Scene& scene, const BenchDevice& device) {
    const SimulationOptions options{
        .drawn = particleCase.drawn.has_value(), .path = particleCase.path, .inPlace = particleCase.inPlace};
    return Simulation(*device.context, compile(scene), options);
}

class StepRunner : public BenchRunner {
  public:
    StepRunner(const ParticleCase& particleCase, const Scene& scene, const BenchDevice& device)
        : particleCase_(particleCase), simulation_(makeSimulation(particleCase, scene, device)) {
        if (particleCase.drawn) draw_ = device.makeDraw(scene, simulation_.plan());
        if (particleCase.sort) makeSorter(device);
        if (!particleCase.sort && !particleCase.contact && !particleCase.drawn && !particleCase.allocator)
            movedBytes = fusedBytesPerFrame(simulation_.plan(), false);
        for (int i = 0; i < framesToSteady(particleCase); ++i)
            simulation_.frame();
        if (!particleCase.allocator) start_ = simulation_.save();
    }
    void restart() override {
        if (start_) simulation_.load(*start_);
    }
    void frame() override {
        simulation_.frame();
        if (sorter_) sort();
        if (draw_) draw_(simulation_.state());
    }
    void finish() override { glFinish(); }
    const Simulation& simulation() const { return simulation_; }

  private:
    void makeSorter(const BenchDevice& device) {
        const size_t pairs = size_t(particleCase_.count());
        const int row = particleCase_.sort == SortMethod::radix ? 0 : particleCase_.side;
        sorter_ = std::make_unique<Sorter>(*device.context, *particleCase_.sort, pairs, row);
        sorter_->upload(randomKeys(pairs));
    }
    void sort() {
        if (particleCase_.spreadFrames == 0) return sorter_->sort();
        if (spread_++ % particleCase_.spreadFrames == 0) sorter_->beginSpread(particleCase_.spreadFrames);
        sorter_->advance();
    }

    ParticleCase particleCase_;
    Simulation simulation_;
    std::optional<SavedState> start_;
    std::unique_ptr<Sorter> sorter_;
    int spread_ = 0;
    Draw draw_;
};

ParticleStep loopStep(const ParticleCase& particleCase, const Scene& scene) {
    const Group& group = scene.groups[0];
    ParticleStep out;
    out.h = 1 / scene.frameRate / scene.solver.substeps;
    out.gravity = scene.gravity;
    out.wind = std::get<UniformField>(*scene.fields[0].shape).velocity;
    out.drag = group.drag.tangent;
    if (particleCase.heights) out.heights = kindOf<HeightFieldCollider>(*scene.colliders[0].shape);
    if (particleCase.turnover == 0) return out;
    out.births = int(particleCase.turnover * particleCase.count());
    out.life = glm::dvec2(0.5, 1.5) / particleCase.turnover / particleCase.frameRate;
    out.from = group.place.box;
    return out;
}

void worldStart(const Scene& scene, std::vector<glm::vec3>& positions, std::vector<glm::vec3>& velocities) {
    const GroupState start = compile(scene).groups[0].start;
    for (size_t i = 0; i < start.anchors.size(); ++i)
        positions.push_back(start.anchors[i] + start.positions[i]);
    velocities = start.velocities;
}

// The step, and its positions to a buffer that a renderer would read.
class LoopRunner : public BenchRunner {
  public:
    LoopRunner(const ParticleCase& particleCase, const Scene& scene, const BenchDevice& device)
        : particleCase_(particleCase),
          scene_(scene),
          step_(loopStep(particleCase, scene_)),
          loop_(size_t(particleCase.count()) + size_t(particleCase.count()) / 4, bestSimd(), device.cores) {
        const size_t bytes =
            4 * sizeof(float) * (size_t(particleCase.count()) + size_t(particleCase.count()) / 4);
        buffer_ = gpu::Buffer(*device.context, gpu::Buffer::Use::vertex, nullptr, bytes, "uploaded");
        if (particleCase.turnover == 0) worldStart(scene_, positions_, velocities_);
        toStart();
    }
    void restart() override {
        if (particleCase_.turnover == 0) toStart();
    }
    void frame() override {
        loop_.step(step_);
        if (particleCase_.sort) return sortAndUpload();
        size_t offset = 0;
        for (const std::span<const float> part : loop_.positions()) {
            if (part.empty()) continue;
            buffer_.update(gpu::Traffic::Kind::state, offset, part.data(), part.size_bytes());
            offset += part.size_bytes();
        }
    }
    void finish() override { glFinish(); }

  private:
    void toStart() {
        if (particleCase_.turnover == 0) loop_.set(positions_, velocities_);
        for (int i = 0; i < framesToSteady(particleCase_); ++i)
            loop_.step(step_);
    }
    // From back to front along z.
    void sortAndUpload() {
        const auto parts = loop_.positions();
        order_.clear();
        sorted_.clear();
        for (size_t p = 0; p < parts.size(); p += 3)
            for (size_t i = 0; i < parts[p].size(); ++i)
                order_.push_back(uint64_t(std::bit_cast<uint32_t>(100 + parts[p + 2][i])) << 32 | p << 28 |
                                 i);
        std::sort(order_.begin(), order_.end());
        for (const uint64_t key : order_) {
            const size_t p = (key >> 28) & 15, i = key & 0xFFFFFFF;
            for (size_t k = 0; k < 3; ++k)
                sorted_.push_back(parts[p + k][i]);
        }
        buffer_.update(gpu::Traffic::Kind::state, 0, sorted_.data(), sorted_.size() * sizeof(float));
    }

    ParticleCase particleCase_;
    Scene scene_;
    ParticleStep step_;
    ParticleBaseline loop_;
    std::vector<glm::vec3> positions_, velocities_;
    std::vector<uint64_t> order_;
    std::vector<float> sorted_;
    gpu::Buffer buffer_;
};

std::unique_ptr<BenchRunner> makeParticleRunner(const ParticleCase& particleCase, const Molecule& point,
                                                const Molecule& quad, const BenchDevice& device) {
    const Scene scene = particleScene(particleCase, point, quad);
    if (particleCase.what == What::step) return std::make_unique<StepRunner>(particleCase, scene, device);
    if (particleCase.what == What::cpuLoop) return std::make_unique<LoopRunner>(particleCase, scene, device);
    BenchCase copy;
    copy.subject = Subject::kernelCopy;
    copy.count = 64;
    const BenchStart none(copy, point, 1);
    copy.count = particleCase.count();
    return makeRunner(copy, point, none, device);
}

std::string reasonToLeaveOut(const ParticleCase& particleCase, const BenchDevice& device) {
    const gpu::ContextInfo& info = device.context->info();
    const bool computes = particleCase.path == Path::fused || particleCase.what == What::copy ||
                          particleCase.sort == SortMethod::radix;
    if (!info.computeShaders && computes)
        return concat("needs OpenGL 4.3; this context has ", info.major, ".", info.minor);
    if (particleCase.contact && particleCase.path == Path::fused) {
        const size_t most = ContactData::most(info, {});
        if (size_t(particleCase.count()) > most) return concat("this context holds the contact of ", most);
    }
    if (particleCase.drawn && !device.makeDraw) return "nothing to draw with";
    return {};
}

class ParticleEntrant {
  public:
    ParticleEntrant(ParticleTimes& result, const Molecule& point, const Molecule& quad,
                    const BenchDevice& device)
        : result_(result),
          runner_(makeParticleRunner(result.benchCase, point, quad, device)),
          context_(*device.context),
          ownTimes_(device.ownTimes && result.benchCase.what != What::cpuLoop) {
        result.movedBytes = runner_->movedBytes;
        result.error = positionError(result.benchCase, point, device);
        if (result.benchCase.allocator) steps_ = dynamic_cast<const StepRunner*>(runner_.get());
        if (steps_) before_ = steps_->simulation().lifeCounts(0);
        if (steps_) framesAtStart_ = steps_->simulation().frames();
    }

    // Not counted: compiles and touches memory; then what a visit costs.
    void warmUp() {
        frames_ = 1;
        visit();
        if (samples_.back() < slowFrameSeconds) frames_ = framesTimed;
        seconds = measure::secondsOf([&] { visit(); });
        samples_.clear();
        device_.clear();
        packing_.clear();
        timedFrames_ = 0;
        moved_ = {};
    }

    void visit() {
        runner_->restart();
        runner_->run(1);
        const gpu::Traffic before = context_.traffic();
        samples_.push_back(measure::secondsOf([&] { runner_->run(frames_); }) / frames_);
        const gpu::Traffic crossed = context_.traffic() - before;
        moved_ +=
            double(crossed.total(gpu::Traffic::Kind::state) + crossed.total(gpu::Traffic::Kind::births));
        timedFrames_ += frames_;
        if (ownTimes_) device_.push_back(timer_.secondsOf([&] { runner_->frame(); }));
        if (!steps_) return;
        const LifeCounts counts = steps_->simulation().lifeCounts(0);
        result_.live = counts.live;
        packing_.push_back(double(counts.mark) / std::max(1, counts.live));
    }

    void finish() {
        result_.frame = measure::spreadOf(samples_);
        result_.device = measure::spreadOf(device_);
        result_.busBytes = moved_ / std::max(1, timedFrames_);
        if (!steps_) return;
        const LifeCounts counts = steps_->simulation().lifeCounts(0);
        const double frames = steps_->simulation().frames() - framesAtStart_;
        result_.born = double(counts.born - before_.born) / frames;
        result_.lost = double(counts.lost - before_.lost) / frames;
        result_.packing = *std::max_element(packing_.begin(), packing_.end());
    }

    double seconds = 0;  // of a visit

  private:
    ParticleTimes& result_;
    std::unique_ptr<BenchRunner> runner_;
    gpu::Context& context_;
    const StepRunner* steps_ = nullptr;  // where they are born
    LifeCounts before_;
    int frames_ = 1, timedFrames_ = 0, framesAtStart_ = 0;
    double moved_ = 0;
    bool ownTimes_;
    gpu::DeviceTimer timer_;
    std::vector<double> samples_, device_, packing_;
};

// Returns the position t s after the start, exactly, under constant force and drag.
glm::dvec3 exactAfter(const Scene& scene, const glm::dvec3& x, const glm::dvec3& v, double t) {
    const double gamma = scene.groups[0].drag.tangent;
    const glm::dvec3 last = std::get<UniformField>(*scene.fields[0].shape).velocity + scene.gravity / gamma;
    return x + last * t + (v - last) * (-std::expm1(-gamma * t) / gamma);
}

}  // namespace

std::optional<double> positionError(const ParticleCase& given, const Molecule& point,
                                    const BenchDevice& device) {
    if (given.heights || given.contact || given.sort || given.drawn || given.turnover > 0 || given.quads ||
        given.what == What::copy)
        return std::nullopt;
    ParticleCase particleCase = given;
    particleCase.side = 64;
    const Scene scene = particleScene(particleCase, point, point);
    const int frames = int(std::lround(scene.frameRate));
    std::vector<glm::vec3> positions, velocities;
    worldStart(scene, positions, velocities);
    std::vector<glm::dvec3> ends;
    if (particleCase.what == What::cpuLoop) {
        ParticleBaseline loop(positions.size(), bestSimd(), device.cores);
        loop.set(positions, velocities);
        for (int i = 0; i < frames; ++i)
            loop.step(loopStep(particleCase, scene));
        for (const ParticleBaseline::Particle& particle : loop.get())
            ends.emplace_back(particle.position);
    } else {
        Simulation simulation = makeSimulation(particleCase, scene, device);
        for (int i = 0; i < frames; ++i)
            simulation.frame();
        ends = simulation.snapshot(0).positions;
    }
    double sum = 0;
    for (size_t i = 0; i < ends.size(); ++i) {
        const glm::dvec3 exact =
            exactAfter(scene, glm::dvec3(positions[i]), glm::dvec3(velocities[i]), frames / scene.frameRate);
        sum += glm::dot(ends[i] - exact, ends[i] - exact) / double(ends.size());
    }
    return std::sqrt(sum);
}

std::vector<ParticleTimes> measureParticles(const std::vector<ParticleCase>& cases, const Molecule& point,
                                            const Molecule& quad, const BenchDevice& device,
                                            const measure::Schedule& schedule) {
    std::vector<ParticleTimes> out;
    out.reserve(cases.size());
    for (const ParticleCase& particleCase : cases)
        out.push_back({.benchCase = particleCase, .leftOut = reasonToLeaveOut(particleCase, device)});
    measureInTurn(
        out, schedule, [](double) {},
        [&](ParticleTimes& times) { return std::make_unique<ParticleEntrant>(times, point, quad, device); });
    device.context->checkErrors("bench particles");
    return out;
}

}  // namespace shoal::bench
