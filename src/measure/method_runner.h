// One solver and field sampling on the device, at any step: kernels do not depend on the step, so that one
// simulation serves them all.
#pragma once

#include <algorithm>
#include <compare>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "measure/timing.h"
#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::measure {

inline constexpr FieldSampling allSamplings[] = {FieldSampling::vertexSubstep, FieldSampling::vertexFrame,
                                                 FieldSampling::moleculeFrame};

struct Method {
    SolverKind solver = SolverKind::leapfrog;
    FieldSampling sampling = FieldSampling::vertexSubstep;
    auto operator<=>(const Method&) const = default;
};
std::string name(const Method& method);  // "leapfrog, vertexFrame"

// Fields differ between samplings unless none is read or all are the same everywhere and always.
std::vector<FieldSampling> samplingsThatDiffer(const Scene& scene);
// All methods of these solvers and samplings; empty: all, and all that differ. Every solver comes once before
// any twice, those of second order and more first, which get there soonest.
std::vector<Method> methodsInTurn(const Scene& scene, std::vector<SolverKind> solvers,
                                  std::vector<FieldSampling> samplings);

// A frame of the scene is run as `split` shorter ones of `substeps` each.
struct Step {
    int substeps = 1, split = 1;
    int perFrame() const { return substeps * split; }  // of the scene's frames
    auto operator<=>(const Step&) const = default;
};

struct AccuracyDevice {
    gpu::Context* context = nullptr;
    int cores = 1;  // threads of the reference
    Path path = Path::automatic;
    Lanes lanes = Lanes::automatic;
    bool inPlace = false;
};

SimulationOptions simulationOptions(const AccuracyDevice& device);  // nothing is drawn, no watchdog

// The scene with at most so many molecules of each group, pins that are never released.
Scene withMolecules(Scene scene, int most);

constexpr double slowFrameSeconds = 0.1;  // above, single frames are timed

class MethodRunner {
  public:
    MethodRunner(Scene scene, Method method, const AccuracyDevice& device);

    // Why the method cannot take this step; empty: it can.
    std::string refusal(Step step) const;
    // Takes a step that is not refused. The first one makes a simulation, and so does one within which stiff
    // molecules are no bodies any more, or are again.
    // Error: the path, the driver or the device's memory refuses the method.
    void set(Step step);

    const Step& step() const { return step_; }  // that is set

    void restart() { simulation_->restart(); }
    void frame() { simulation_->frame(); }  // 1 / (frameRate * split) seconds
    void finish() const;                    // waits until the frames are done
    // One frame of the step that is set, and back to the start: programs may be built again where it is new.
    // Returns the seconds that it took.
    double warmUp();
    // A whole run from the start: `frames` of the scene's own.
    void run(int frames);
    // Seconds that one frame at this step takes: the shorter of two after one that is not timed, or where
    // frames are long the one.
    double secondsOfFrame(Step step);

    std::vector<Snapshot> snapshots() const;  // one a group
    const Simulation& simulation() const { return *simulation_; }
    int64_t vertices() const;  // of all groups

  private:
    Scene sceneAt(Step step) const;

    Scene scene_;
    Method method_;
    AccuracyDevice device_;
    Step step_;
    // One for each way in which contact treats the molecules, which follows from the step.
    std::vector<std::unique_ptr<Simulation>> simulations_;
    Simulation* simulation_ = nullptr;  // of the step that is set
};

// A frame of so many substeps takes about base + each * substeps.
struct FrameCost {
    double base = 0, each = 0;  // s
    double seconds(const Step& step) const { return base + each * step.substeps; }
};
FrameCost frameCost(MethodRunner& runner);

// The smallest error of a method's steps until now.
struct SmallestError {
    double error = std::numeric_limits<double>::infinity();
    int since = 0;  // steps that did not better it
    // With the error of a finer step: whether it is below 0.01, and three finer steps did not better it.
    bool isPassedBy(double finer) {
        since = finer < 0.95 * error ? 0 : since + 1;
        error = std::min(error, finer);
        return since >= 3 && error < 0.01;
    }
};

// A method on a few molecules, for its error, and on many, for its time.
struct MethodOnBoth {
    Method method;
    std::unique_ptr<MethodRunner> few, many;
    FrameCost manyCost = {};
    double compiling = 0;      // s, until both had run their first frame
    std::string refused = {};  // why it takes no step; empty: it is ready
};
// Compiles the method for the first of the steps that it takes, and looks at what frames of many cost.
MethodOnBoth makeReady(const Method& method, const Scene& few, const Scene& many,
                       const std::vector<Step>& steps, const AccuracyDevice& device);

// Times of many methods and steps, in turn, round after round, so that a machine whose speed drifts drifts
// for all alike.
struct Contender {
    MethodRunner* runner = nullptr;
    Step step;
    double secondsOfFrame = 0;  // about
    double secondsOfStep = 0;   // that setting the step takes: some methods build their program again
};

// Seconds that one visit of a contender takes: its step is set, and one frame from the start is run and
// waited for, untimed, because it may build programs; back to the start, and a wait; then its first 2 to 32
// frames are timed, between two waits, or the first one alone where frames are long.
double secondsOfVisit(const Contender& contender);

// Estimates the seconds of all samples: the least number of each, and more while they fit into half a minute.
double leastSeconds(const std::vector<Contender>& contenders);

// Flags the contenders that fit when each takes its seconds, cheapest first: that always does. Nothing bounds
// them: all.
std::vector<bool> thoseThatFit(const std::vector<double>& cost, std::optional<double> seconds);

// Visits in turn, round after round; `visit(i)` is left out where it would end after `seconds`, by `clock`
// (s) and by the dearest of its own visits before. The very first one is not.
void visitInTurn(const std::vector<double>& cost, std::optional<double> seconds,
                 const std::function<double()>& clock, const std::function<void(size_t)>& visit);

// Seconds a frame. With `seconds`, what does not fit goes without samples, the dearest first.
// `tell`: seconds that are done.
std::vector<Spread> timeInTurn(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               const std::function<void(double)>& tell);

}  // namespace shoal::measure
