#include "measure/method_runner.h"

#include <algorithm>

#include "compile/choose_solver.h"
#include "gpu/gl.h"
#include "scene/field_kinds.h"

namespace shoal::measure {

std::vector<FieldSampling> samplingsThatDiffer(const Scene& scene) {
    const bool dragged = std::any_of(scene.groups.begin(), scene.groups.end(),
                                     [](const Group& group) { return group.drag.any(); });
    const bool varies = std::any_of(scene.fields.begin(), scene.fields.end(), [](const Field& field) {
        return field.box || !std::holds_alternative<UniformField>(*field.shape);
    });
    if (!dragged || !varies) return {FieldSampling::vertexSubstep};
    return {std::begin(allSamplings), std::end(allSamplings)};
}

std::vector<Method> methodsInTurn(const Scene& scene, std::vector<SolverKind> kinds,
                                  std::vector<FieldSampling> samplings) {
    if (kinds.empty())
        for (const Solver& solver : solvers())
            kinds.push_back(solver.kind);
    std::stable_partition(kinds.begin(), kinds.end(), [](SolverKind kind) { return solver(kind).order > 1; });
    if (samplings.empty()) samplings = samplingsThatDiffer(scene);
    std::vector<Method> out;
    for (const FieldSampling sampling : samplings)
        for (const SolverKind kind : kinds)
            out.push_back({kind, sampling});
    return out;
}

std::string name(const Method& method) {
    return concat(name(method.solver), ", ", name(method.sampling));
}

SimulationOptions simulationOptions(const AccuracyDevice& device) {
    SimulationOptions out;
    out.drawn = false;
    out.path = device.path;
    out.lanes = device.lanes;
    out.inPlace = device.inPlace;
    out.watchdog = false;  // what blows up is an outcome here
    return out;
}

Scene withMolecules(Scene scene, int most) {
    for (Group& group : scene.groups) {
        group.count = std::min(group.count, most);
        group.release.reset();
    }
    return scene;
}

MethodRunner::MethodRunner(Scene scene, Method method, const AccuracyDevice& device)
    : scene_(std::move(scene)), method_(method), device_(device) {
    scene_.solver.kind = method.solver;
    scene_.solver.fieldSampling = method.sampling;
}

Scene MethodRunner::sceneAt(Step step) const {
    Scene out = scene_;
    out.solver.substeps = step.substeps;
    out.frameRate *= step.split;
    return out;
}

std::string MethodRunner::refusal(Step step) const {
    try {
        compile(withMolecules(sceneAt(step), 1));  // whether it is refused does not depend on their number
        return {};
    } catch (const Error& error) {
        return error.message();
    }
}

void MethodRunner::set(Step step) {
    const double substep = 1 / (scene_.frameRate * step.perFrame());
    const auto fits = [&](const std::unique_ptr<Simulation>& simulation) {
        const std::vector<GroupPlan>& groups = simulation->plan().groups;
        return std::all_of(groups.begin(), groups.end(), [&](const GroupPlan& group) {
            return group.rigid == isRigidWithin(group, substep);
        });
    };
    const auto known = std::find_if(simulations_.begin(), simulations_.end(), fits);
    // A step that is refused serves only to look at what steps cost: any simulation will do.
    if (known == simulations_.end() && (!simulation_ || refusal(step).empty())) {
        simulations_.push_back(std::make_unique<Simulation>(*device_.context, compile(sceneAt(step)),
                                                            simulationOptions(device_)));
        simulation_ = simulations_.back().get();
    } else if (known != simulations_.end()) {
        simulation_ = known->get();
    }
    step_ = step;
    simulation_->parameters.substeps = step.substeps;
    simulation_->parameters.frameTime = 1 / (scene_.frameRate * step.split);
}

void MethodRunner::finish() const {
    glFinish();
}

double MethodRunner::warmUp() {
    return secondsOf([this] {
        restart();
        frame();
        finish();
        restart();
        finish();
    });
}

void MethodRunner::run(int frames) {
    restart();
    for (int i = 0; i < frames * step_.split; ++i)
        frame();
    finish();
}

double MethodRunner::secondsOfFrame(Step step) {
    set(step);
    restart();
    const auto secondsOfNext = [this] {
        finish();
        return secondsOf([this] {
            frame();
            finish();
        });
    };
    secondsOfNext();
    const double seconds = secondsOfNext();
    return seconds > slowFrameSeconds ? seconds : std::min(seconds, secondsOfNext());
}

std::vector<Snapshot> MethodRunner::snapshots() const {
    std::vector<Snapshot> out;
    for (size_t g = 0; g < scene_.groups.size(); ++g)
        out.push_back(simulation_->snapshot(g));
    return out;
}

int64_t MethodRunner::vertices() const {
    int64_t out = 0;
    for (const Group& group : scene_.groups)
        out += int64_t(group.count) * int64_t(group.molecule.vertices.size());
    return out;
}

FrameCost frameCost(MethodRunner& runner) {
    constexpr Step few{4, 1};
    const double a = runner.secondsOfFrame(few);
    const Step more{a > slowFrameSeconds ? 8 : 32, 1};
    const double b = runner.secondsOfFrame(more);
    const double each = std::max(0.0, (b - a) / (more.substeps - few.substeps));
    return {std::max(0.0, a - each * few.substeps), each};
}

MethodOnBoth makeReady(const Method& method, const Scene& few, const Scene& many,
                       const std::vector<Step>& steps, const AccuracyDevice& device) {
    MethodOnBoth out{.method = method,
                     .few = std::make_unique<MethodRunner>(few, method, device),
                     .many = std::make_unique<MethodRunner>(many, method, device)};
    for (const Step& step : steps) {
        out.refused = out.few->refusal(step);
        if (!out.refused.empty()) continue;
        try {
            out.compiling = secondsOf([&] {
                for (MethodRunner* runner : {out.few.get(), out.many.get()}) {
                    runner->set(step);
                    pinRasteriserThreads();
                    runner->warmUp();
                }
            });
            out.manyCost = frameCost(*out.many);
        } catch (const Error& error) {
            out.refused = error.what();
        }
        break;
    }
    return out;
}

}  // namespace shoal::measure
