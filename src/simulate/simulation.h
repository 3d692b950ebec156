// Runs a plan on one of the paths (compile/path.h). After construction a frame moves no byte of state
// over the bus; `snapshot` and `save` read it back when asked.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/context.h"
#include "gpu/pass_timers.h"
#include "simulate/execution_path.h"
#include "simulate/step.h"
#include "simulate/tables.h"
#include "simulate/watchdog.h"

namespace shoal {

// A group's state in double precision and world coordinates; index = molecule * vertexCount + vertex.
struct Snapshot {
    double time = 0;
    int count = 0, vertexCount = 0;
    std::vector<glm::dvec3> positions, velocities;  // m, m/s
    std::vector<glm::vec3> normals;                 // unit; zero where the shape has no triangles
    std::vector<bool> released;                     // per molecule: pins are released
    std::vector<bool> alive;                        // per molecule; empty: all, for ever
    std::vector<glm::vec2> lives;                   // x age, y length of life, s; empty likewise
    std::vector<uint32_t> seeds;                    // per molecule
};

// All that a run goes on from, exact to the bit: another simulation of the same plan, on any path, can
// take it.
struct SavedState {
    double time = 0;  // s
    int frames = 0;
    std::vector<GroupState> groups;
    // s, of the last substep; 0: none, or forces have jumped since. A solver with history goes on only with
    // the same.
    double step = 0;
    ContactMemory contacts;
};

class Simulation {
  public:
    // Error: choosePath's; out of memory; the driver refuses a shader.
    Simulation(gpu::Context& context, Plan plan, const SimulationOptions& options = {});
    Simulation(const Simulation&) = delete;  // the path refers to the plan and the tables
    Simulation& operator=(const Simulation&) = delete;

    // Advances by parameters.frameTime. gpu::DeviceLost: the driver has reset the device. Runaway: check's,
    // of the frame before, on a GPU of one up to four frames before; nothing moves then, and time and frames
    // are those of the frame that left that state.
    void frame();
    // Waits for the last frame. Runaway: it, or one before it, left a state that is not finite or too fast.
    // That stays so until a restart or another state is loaded.
    void check();
    void restart();  // back to the start state, which is uploaded again

    Parameters parameters;
    const Plan& plan() const { return plan_; }
    const PathChoice& path() const { return choice_; }
    // Tells how the group's molecules are spread; automatic on the ping-pong path.
    Lanes lanes(size_t group) const { return path_->lanes(group); }
    StateView state() const;     // simulate/state_view.h
    size_t stateBytes() const {  // on the device
        return shoal::stateBytes(plan_, choice_.path, options_.drawn, options_.inPlace);
    }
    double time() const { return time_; }
    int frames() const { return frames_; }
    gpu::PassTimers& timers() { return timers_; }
    gpu::Context& context() const { return *context_; }
    // Returns the contact of molecules with one another; null: there is none.
    const ContactResult* contact() const { return path_->contact(); }
    // Counts a group with life. Waits; reads 128 bytes of control.
    LifeCounts lifeCounts(size_t group) const { return path_->lifeCounts(group); }
    // Other numbers for birth and death, from the next frame on. False, and nothing changes: what differs
    // needs another plan.
    bool changeLife(size_t group, const Lifecycle& life) { return path_->changeLife(group, life); }
    // Other numbers for the springs of a group, from the next frame on; `molecule` is the group's otherwise.
    // Compiles nothing. False, and nothing changes: the plan's springs are not live (CompileOptions), are
    // others, or the path does not read them.
    bool changeSprings(size_t group, const Molecule& molecule);
    // Other numbers for how a group's molecules steer, from the next frame on. False, and nothing changes: it
    // has no school, or what differs needs another plan.
    bool changeSchool(size_t group, const School& school);
    // Tells what was done otherwise than asked, such as one side instead of two for want of memory.
    const std::vector<Warning>& warnings() const { return warnings_; }

    // State bytes are counted as they cross the bus.
    Snapshot snapshot(size_t group) const;
    // Reads so many molecules from `first` on, with their scales and phases in `looks`, without history and
    // steering. Waits. On the fused path whole blocks of 16 cross the bus.
    GroupState readMolecules(size_t group, size_t first, size_t count) const {
        return path_->readSome(group, first, count);
    }
    SavedState save() const;
    // Returns the state before the last frame, to look closer at what went wrong in it. Nothing where that
    // state is gone: on the ping-pong path, in place, with births, deaths or schools, and without a frame
    // since the last load or restart.
    std::optional<SavedState> saveBefore() const;
    void load(const SavedState& saved);
    uint64_t hash() const;  // of the whole state's bits (FNV-1a): same scene, path and driver, same bits

  private:
    PathChoice chooseRight(const SimulationOptions& options);
    std::unique_ptr<ExecutionPath> makePath();
    void goOn(double time, int frames, double step);
    void stopWhereItRanAway(bool waits);
    bool forcesJump() const;

    gpu::Context* context_;
    Plan plan_;
    std::vector<Warning> warnings_;
    PathLimits limits_;
    PathChoice choice_;
    Tables tables_;
    SimulationOptions options_;
    gpu::PassTimers timers_;
    std::unique_ptr<ExecutionPath> path_;
    double time_ = 0;  // s
    int frames_ = 0;
    // s, a substep of the last frame; 0: none yet, or what it left behind does not count.
    double lastStep_ = 0;
    struct Issued {
        Frame frame;
        double stepBefore;  // s, lastStep_ at its start
    };
    // The last frames, as many as may have to be taken back and one more; empty: none since the start or a
    // load.
    std::deque<Issued> issued_;
};

}  // namespace shoal
