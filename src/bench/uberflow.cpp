#include "bench/collide.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "bench/sort.h"
#include "gpu/gl.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using glm::vec3;

constexpr double frameRate = 60, gamma = 1, half = 4, mostRadius = 0.01;

struct Experiment {
    const char *name, *how;
    std::vector<double> published;
    bool heights = false;
    std::optional<SortMethod> sort = {};
    bool rows = false;  // the sort is of rows only, and takes the place of the grid's
    bool onCpu = false;
    std::optional<ContactSearch> search = {};
    ContactResponse response = ContactResponse::nearest;
    bool blended = false;  // sorted, and blended in that order, as part of the picture
};

std::vector<Experiment> experiments() {
    using Search = ContactSearch;
    return {
        {.name = "E1", .how = "", .published = {640, 320, 120}},
        {.name = "E2", .how = "", .published = {155, 96, 42}, .heights = true},
        {.name = "E3", .how = "bitonic", .published = {39, 8, 1.4}, .sort = SortMethod::bitonic},
        {.name = "E3", .how = "radix", .published = {}, .sort = SortMethod::radix},
        {.name = "E3", .how = "blended in order in the picture", .published = {}, .blended = true},
        {.name = "E4",
         .how = "rows only, nearest partner",
         .published = {133, 31, 7},
         .sort = SortMethod::bitonic,
         .rows = true,
         .search = Search::single},
        {.name = "E4", .how = "full sort, nearest partner", .published = {}, .search = Search::single},
        {.name = "E4",
         .how = "staggered grid, nearest partner",
         .published = {},
         .search = Search::staggered},
        {.name = "E4",
         .how = "exact, all partners",
         .published = {},
         .search = Search::exact,
         .response = ContactResponse::simultaneous},
        {.name = "E5", .how = "std::sort", .published = {7, 2, 0.4}, .onCpu = true},
    };
}

// Particles in a cube, in a vortex; with contact about a fifth of a sphere a cell.
Scene sceneOf(const Experiment& one, int side, const Molecule& point) {
    Scene scene;
    scene.name = concat("UberFlow ", one.name);
    scene.frameRate = frameRate;
    scene.gravity = {0, -1, 0};
    scene.solver.kind = SolverKind::euler;
    scene.solver.substeps = 1;
    scene.contact.steps = 1;
    scene.contact.response = one.response;
    scene.contact.search = one.search.value_or(ContactSearch::exact);
    scene.fields.emplace_back().shape = VortexField{};
    if (one.heights) scene.colliders.emplace_back().shape = hills(half);
    Group group;
    group.name = "particles";
    group.molecule = point;
    group.count = side * side;
    group.place.box = {glm::dvec3(-half), glm::dvec3(half)};
    group.drag = {gamma, gamma};
    if (one.search) {
        const double cell = std::cbrt(std::pow(2 * half, 3) * 0.2 / group.count);
        group.contact.emplace().radius = std::min(mostRadius, cell / 4.2);
    }
    if (one.blended) {
        group.molecule.material.blend = Blend::alpha;
        group.molecule.material.opacity = 0.5;
    }
    scene.groups.push_back(group);
    scene.light.shadows = false;
    scene.camera.eye = {0, 2, 14};
    scene.camera.target = {0, 0, 0};
    return scene;
}

template <typename Work>
double timed(const Work& work) {
    glFinish();
    return measure::secondsOf([&] {
        work();
        glFinish();
    });
}

// E5: what a particle engine on the CPU does in a frame. One thread, plain arrays.
class CpuParticles {
  public:
    CpuParticles(const GroupState& start, gpu::Context& context)
        : anchors_(start.anchors), relative_(start.positions), velocities_(start.velocities) {
        const std::vector<glm::vec4> none(anchors_.size());
        buffer_ = gpu::Buffer(context, gpu::Buffer::Use::vertex, std::span<const glm::vec4>(none), "E5");
        sorted_.resize(anchors_.size());
        order_.resize(anchors_.size());
        positions_.resize(anchors_.size());
        restart();
    }
    void restart() {
        for (size_t i = 0; i < anchors_.size(); ++i)
            positions_[i] = anchors_[i] + relative_[i];
        current_ = velocities_;
    }
    // Moves all particles by a frame, with the scene's field, drag and gravity.
    void move() {
        const VortexField field;
        const auto h = float(1 / frameRate), decay = float(-std::expm1(-gamma / frameRate)),
                   phi = float(-std::expm1(-gamma / frameRate) / gamma);
        const auto speed = float(2 * field.speed / field.radius), lift = float(field.lift);
        for (size_t i = 0; i < positions_.size(); ++i) {
            const vec3 p = positions_[i];
            const float core = 1 / (1 + (p.x * p.x + p.z * p.z) * float(1 / (field.radius * field.radius)));
            const vec3 u = vec3(p.z * speed, lift, -p.x * speed) * core;
            current_[i] += (u - current_[i]) * decay + vec3(0, -1, 0) * phi;
            positions_[i] += current_[i] * h;
        }
    }
    // Back to front along the view, and up in that order.
    void sortAndUpload() {
        for (size_t i = 0; i < positions_.size(); ++i) {
            const float depth = 100 + positions_[i].z;  // above 0: its bits are in its order
            order_[i] = uint64_t(std::bit_cast<uint32_t>(depth)) << 32 | i;
        }
        std::sort(order_.begin(), order_.end());
        for (size_t i = 0; i < order_.size(); ++i)
            sorted_[i] = glm::vec4(positions_[size_t(order_[i] & 0xFFFFFFFFu)], 1);
        buffer_.update(gpu::Traffic::Kind::state, 0, sorted_.data(), sorted_.size() * sizeof(glm::vec4));
    }

  private:
    std::vector<vec3> anchors_, relative_, velocities_, positions_, current_;
    std::vector<glm::vec4> sorted_;
    std::vector<uint64_t> order_;
    gpu::Buffer buffer_;
};

class UberFlowEntrant {
  public:
    UberFlowEntrant(UberFlowTimes& result, const Experiment& one, const Molecule& point,
                    const BenchDevice& device)
        : result_(result), one_(one) {
        const int side = result.side;
        const Scene scene = sceneOf(one_, side, point);
        Plan plan = compile(scene);
        const int bits = plan.contact.tableBits;
        const GroupState start = plan.groups[0].start;
        simulation_ = std::make_unique<Simulation>(
            *device.context, device.shaderRoot, std::move(plan),
            SimulationOptions{.timing = gpu::PassTimers::Mode::finish, .cache = device.cache});
        if (device.makeDraw) draw_ = device.makeDraw(scene, simulation_->plan());
        if (one_.onCpu) cpu_ = std::make_unique<CpuParticles>(start, *device.context);
        const auto sorter = [&](SortMethod method) {
            return std::make_unique<Sorter>(*device.context, device.shaderRoot, method, size_t(side * side),
                                            method == SortMethod::bitonic ? side : 0, device.cache);
        };
        if (one_.sort) sorter_ = sorter(*one_.sort);
        if (one_.search) {
            gridBits_ = bits;
            grid_ = sorter(SortMethod::radix);
        }
        keys_ = randomKeys(size_t(side) * size_t(side), one_.search ? (1u << bits) - 1 : ~0u);
    }

    void warmUp() {
        visit();
        seconds = measure::secondsOf([&] { visit(); });
        for (std::vector<double>& samples : samples_)
            samples.clear();
    }

    void visit() {
        simulation_->restart();
        if (sorter_) sorter_->upload(keys_);
        if (grid_) grid_->upload(keys_);
        if (cpu_) cpu_->restart();
        double contact = 0, sort = 0;
        double motion = timed([&] { cpu_ ? cpu_->move() : simulation_->frame(); });
        if (one_.search) {
            // the grid's own sort is measured by itself, and stands with the sorts
            const double all = motion;
            motion = lastOf(simulation_->timers(), "fused");
            const double gridSort = timed([&] { grid_->sort(gridBits_); });
            const double sorts = one_.search == ContactSearch::staggered ? 2 : 1;
            contact = std::max(0.0, all - motion - sorts * gridSort);
            if (!one_.rows) sort = sorts * gridSort;
        }
        if (cpu_) sort = timed([&] { cpu_->sortAndUpload(); });
        if (sorter_) sort = timed([&] { one_.rows ? sorter_->sortRows() : sorter_->sort(); });
        const double drawing = draw_ ? timed([&] { draw_(simulation_->state()); }) : 0;
        const double taken[] = {motion, contact, sort, drawing, motion + contact + sort + drawing};
        for (size_t i = 0; i < std::size(times); ++i)
            samples_[i].push_back(taken[i]);
    }

    void finish() {
        for (size_t i = 0; i < std::size(times); ++i)
            result_.*times[i] = measure::spreadOf(samples_[i]);
    }

    double seconds = 0;  // of a visit

  private:
    static constexpr measure::Spread UberFlowTimes::*times[] = {&UberFlowTimes::motion,
                                                                &UberFlowTimes::contact, &UberFlowTimes::sort,
                                                                &UberFlowTimes::draw, &UberFlowTimes::frame};

    UberFlowTimes& result_;
    const Experiment& one_;
    int gridBits_ = 0;
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Sorter> sorter_, grid_;
    std::unique_ptr<CpuParticles> cpu_;
    Draw draw_;
    std::vector<KeyIndex> keys_;
    std::vector<double> samples_[std::size(times)];  // s
};

}  // namespace

std::vector<int> uberFlowSides(bool quick) {
    if (quick) return {256};
    return {256, 512, 1024};
}

std::vector<UberFlowTimes> measureUberFlow(int side, const Molecule& point, const BenchDevice& device,
                                           const measure::Schedule& schedule, const BenchProgress& progress) {
    const std::vector<Experiment> all = experiments();
    const bool compute = device.context->info().computeShaders;
    std::vector<UberFlowTimes> out;
    for (const Experiment& one : all) {
        const bool runs = compute || (!one.search && one.sort != SortMethod::radix);
        out.push_back({one.name, one.how, one.published, side, runs ? "" : "needs OpenGL 4.3"});
    }
    measureInTurn(out, schedule, progress, [&](UberFlowTimes& times) {
        return std::make_unique<UberFlowEntrant>(times, all[size_t(&times - out.data())], point, device);
    });
    device.context->checkErrors("bench collide");
    return out;
}

}  // namespace shoal::bench
