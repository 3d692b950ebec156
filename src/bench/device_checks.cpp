#include "bench/device_checks.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "measure/timing.h"
#include "molecule/molecule_file.h"
#include "scene/field_kinds.h"
#include "scene/json/scene_file.h"
#include "simulate/fused.h"
#include "simulate/self_check.h"

namespace shoal::bench {

namespace {

constexpr int mostMolecules = 1000, placesFactor = 4;
constexpr int solverMolecules = 256;
constexpr int agreeingFrame = 20, repeatedFrames = 20;
constexpr int agreeingMolecules = 200;
// The share of a molecule's size that two ways of one frame may differ by; a rounding is 6e-8 m. The
// iterations of contact between molecules pass roundings on.
constexpr double apart = 1e-5, apartInContact = 1e-4;
// The share of molecules that may differ by more: a rounding decides when one touches something or tears off.
constexpr double exceptions = 0.05;

std::unique_ptr<Simulation> checkedSimulation(const Scene& scene, const BenchDevice& device,
                                              SimulationOptions options) {
    options.drawn = false;
    return std::make_unique<Simulation>(*device.context, compile(scene), options);
}

void advance(Simulation& simulation, int frames) {
    for (int i = 0; i < frames; ++i)
        simulation.frame();
    simulation.check();
}

void limitCounts(Scene& scene, int most) {
    for (Group& group : scene.groups) {
        group.count = std::min(group.count, most);
        if (group.life) group.life->capacity = std::min(group.life->capacity, placesFactor * most);
    }
}

Mismatch stateMismatch(const std::string& name, const Scene& scene, const StoredStates& stored,
                       const BenchDevice& device) {
    const StoredState* state = stored.find(name);
    if (!state) throw Error("no state of it is stored (docs/testing.md)");
    const auto simulation = checkedSimulation(scene, device, {});
    advance(*simulation, state->frames);
    if (simulation->plan().groups.size() != state->groups.size())
        throw Error("the stored state has other groups");
    Mismatch out;
    for (size_t g = 0; g < state->groups.size(); ++g) {
        const Mismatch found = mismatch(*simulation, state->groups[g], g);
        if (out.worst.empty() || found.ofTolerance > out.ofTolerance) out = found;
    }
    return out;
}

// The share of the group's molecules that end further apart than rounding explains, and the furthest.
std::pair<double, double> difference(const GroupPlan& group, const Snapshot& a, const Snapshot& b,
                                     double frame, double tolerated) {
    const auto vertices = size_t(group.vertexCount);
    int differ = 0;
    double furthest = 0;
    for (size_t m = 0; m < size_t(group.count); ++m) {
        const bool lives = a.alive.empty() || (a.alive[m] && b.alive[m]);
        double most = 0;
        for (size_t i = m * vertices; lives && i < (m + 1) * vertices; ++i)
            most = std::max({most, glm::length(a.positions[i] - b.positions[i]) / group.size,
                             glm::length(a.velocities[i] - b.velocities[i]) * frame / group.size});
        const bool livesDiffer =
            (!a.alive.empty() && a.alive[m] != b.alive[m]) || a.released[m] != b.released[m];
        differ += livesDiffer || !(most <= tolerated);
        furthest = std::max(furthest, most);
    }
    return {double(differ) / std::max(1, group.count), furthest};
}

Mismatch agreement(const Scene& scene, const SimulationOptions& first, const SimulationOptions& second,
                   const BenchDevice& device) {
    const auto a = checkedSimulation(scene, device, first), b = checkedSimulation(scene, device, second);
    advance(*a, agreeingFrame);
    b->load(a->save());
    advance(*a, 1);
    advance(*b, 1);
    Mismatch out;
    for (size_t g = 0; g < a->plan().groups.size(); ++g) {
        const GroupPlan& group = a->plan().groups[g];
        const auto [share, furthest] =
            difference(group, a->snapshot(g), b->snapshot(g), a->parameters.frameTime,
                       a->plan().contact.find(g) ? apartInContact : apart);
        if (!out.worst.empty() && share / exceptions < out.ofTolerance) continue;
        out = {share / exceptions,
               formatted("%s: %.1f %% of the molecules apart, the furthest by %.2g of its size",
                         group.name.c_str(), share * 100, furthest)};
    }
    return out;
}

void needCompute(const BenchDevice& device) {
    const gpu::ContextInfo& info = device.context->info();
    if (!info.computeShaders)
        throw LeftOut(concat("needs OpenGL 4.3; this context has ", info.major, ".", info.minor));
}

// In a gust, with drag by direction, onto a plane; some land within half a second.
Scene falling(const std::string& folder, const std::string& molecule, SolverKind solver) {
    Scene scene;
    scene.name = molecule;
    scene.gravity = {0, -9.81, 0};
    GustField gust;
    gust.direction = {1, 0, 0.3};
    gust.speed = 2;
    scene.fields.emplace_back().shape = gust;
    scene.colliders.emplace_back();  // a plane, y = 0
    Group& group = scene.groups.emplace_back();
    group.name = molecule;
    group.molecule = readMolecule(concat(folder, "/", molecule, ".json"));
    group.count = solverMolecules;
    group.place.kind = Placement::Kind::volume;
    group.place.box = {{-2, 0.2, -2}, {2, 3, 2}};
    group.place.turn = Placement::Turn::any;
    group.drag = {6, 0.6};
    scene.solver.kind = solver;
    scene.solver.substeps = maxSubsteps;
    scene.solver.substeps = substepsNeeded(compile(scene), 1 / scene.frameRate, 1, 1, 1, 4);
    return scene;
}

// Checks run later, and hold on to it.
class CheckMaker : public std::enable_shared_from_this<CheckMaker> {
  public:
    CheckMaker(const std::vector<NamedFile>& scenes, const std::string& moleculeFolder,
               const StoredStates& stored, const BenchDevice& device)
        : scenes_(scenes), folder_(moleculeFolder), stored_(stored), device_(device) {}

    std::vector<DeviceCheck> all() {
        for (const auto& [name, file] : scenes_)
            add("state", name, [this, name = name, file = file] {
                return stateMismatch(name, checkedScene(file), stored_, device_);
            });
        for (const auto& [name, scene] : solverScenes(folder_))
            add("state", name, [this, name = name, scene = scene] {
                if (solver(*scene.solver.kind).spread) needCompute(device_);
                return stateMismatch(name, scene, stored_, device_);
            });
        selfChecks();
        paths();
        forms();
        for (const char* name : {"tree/leaves", "tree/falling-leaves", "reef/school", "jar/sweets"})
            add("repeat", name, [this, name] { return repeats(sceneNamed(name)); });
        return std::move(out_);
    }

  private:
    void add(const char* kind, const std::string& name, std::function<Mismatch()> run) {
        out_.push_back({kind, name, [self = shared_from_this(), run = std::move(run)] { return run(); }});
    }

    Scene sceneNamed(const std::string& name) const {
        for (const auto& [known, file] : scenes_) {
            if (known != name) continue;
            Scene out = checkedScene(file);
            limitCounts(out, agreeingMolecules);
            return out;
        }
        throw Error("no scene of this name ships");
    }

    // Makes the check by which auto decides on a path.
    void selfChecks() {
        for (const Path path : {Path::fused, Path::fragments, Path::pingPong})
            for (const CheckedPart part : {CheckedPart::step, CheckedPart::contact})
                add("self-check",
                    concat(shoal::name(path), part == CheckedPart::step ? ", step" : ", contact"),
                    [this, path, part] {
                        if (path == Path::fused) needCompute(device_);
                        const double error = selfCheckError(*device_.context, path, part);
                        return Mismatch{error / selfCheckTolerance, formatted("%.2g mm off", error * 1000)};
                    });
    }

    // Fields, pins and springs; colliders; births; schools; contact.
    void paths() {
        for (const char* name :
             {"tree/leaves", "hello/hello", "fountain/fountain", "reef/school", "jar/sweets"})
            add("agree", concat(name, ", fused and fragments"), [this, name] {
                needCompute(device_);
                return agreement(sceneNamed(name), {.path = Path::fused}, {.path = Path::fragments}, device_);
            });
        for (const char* name : {"tree/leaves", "hello/hello"})
            add("agree", concat(name, ", fused and ping-pong"), [this, name] {
                const bool compute = device_.context->info().computeShaders;
                return agreement(sceneNamed(name), {.path = compute ? Path::fused : Path::fragments},
                                 {.path = Path::pingPong}, device_);
            });
    }

    // How the kernel spreads molecules, from the smallest to one that fills it.
    void forms() {
        for (const char* molecule : {"quad", "leaf", "fish"})
            add("agree", concat(molecule, ", a lane a molecule and a lane a vertex"), [this, molecule] {
                needCompute(device_);
                const Scene scene = falling(folder_, molecule, SolverKind::leapfrog);
                return agreement(scene, {.path = Path::fused, .lanes = Lanes::molecule},
                                 {.path = Path::fused, .lanes = Lanes::vertex}, device_);
            });
    }

    Mismatch repeats(const Scene& scene) const {
        const auto simulation = checkedSimulation(scene, device_, {});
        advance(*simulation, repeatedFrames);
        const uint64_t first = simulation->hash();
        simulation->restart();
        advance(*simulation, repeatedFrames);
        const bool same = simulation->hash() == first;
        return {same ? 0.0 : 1e30, same ? "the same bits" : "other bits the second time"};
    }

    const std::vector<NamedFile>& scenes_;
    std::string folder_;
    const StoredStates& stored_;
    const BenchDevice& device_;
    std::vector<DeviceCheck> out_;
};

}  // namespace

DeviceCheckResult runCheck(const DeviceCheck& check, gpu::Context& context) {
    DeviceCheckResult out{check.kind, check.name, {}, {}, {}, 0};
    out.seconds = measure::secondsOf([&] {
        try {
            out.mismatch = check.run();
            context.checkErrors("the check");
        } catch (const LeftOut& error) {
            out.leftOut = error.message();
        } catch (const std::exception& error) {
            out.failed = error.what();
        }
    });
    context.checkAlive();
    return out;
}

Scene checkedScene(const std::string& file) {
    Scene out = readScene(file);
    limitCounts(out, mostMolecules);
    return out;
}

std::vector<std::pair<std::string, Scene>> solverScenes(const std::string& moleculeFolder) {
    std::vector<std::pair<std::string, Scene>> out;
    for (const Solver& solver : solvers())
        out.emplace_back(concat("solver ", solver.name), falling(moleculeFolder, "leaf", solver.kind));
    return out;
}

std::vector<DeviceCheck> deviceChecks(const std::vector<NamedFile>& scenes, const std::string& moleculeFolder,
                                      const StoredStates& stored, const BenchDevice& device) {
    return std::make_shared<CheckMaker>(scenes, moleculeFolder, stored, device)->all();
}

}  // namespace shoal::bench
