// Runs a plan on one of the two paths (compile/path.h). After construction a frame moves no byte of state
// over the bus; `snapshot` and `save` read it back when asked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "compile/path.h"
#include "gpu/context.h"
#include "gpu/pass_timers.h"
#include "simulate/fused.h"
#include "simulate/parameters.h"
#include "simulate/ping_pong.h"
#include "simulate/state_view.h"
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
};

// All that a run goes on from, exact to the bit: another simulation of the same plan, on either path, can
// take it.
struct SavedState {
    double time = 0;  // s
    int frames = 0;
    std::vector<GroupState> groups;
    // s, of the last substep; 0: none, or forces have jumped since. A solver with history goes on only with
    // the same.
    double step = 0;
};

struct SimulationOptions {
    // Normals are computed at the end of each frame, for the renderer and for exports.
    bool drawn = true;
    gpu::PassTimers::Mode timing = gpu::PassTimers::Mode::off;
    Path path = Path::automatic;
    bool inPlace = false;            // fused: half the memory of the state
    Lanes lanes = Lanes::automatic;  // fused: how molecules are spread
    gpu::ProgramCache* cache = nullptr;
    bool watchdog = true;  // simulate/watchdog.h
};

class Simulation {
  public:
    // Error: choosePath's; out of memory; the driver refuses a shader.
    Simulation(gpu::Context& context, const std::string& shaderRoot, Plan plan,
               const SimulationOptions& options = {});
    Simulation(const Simulation&) = delete;  // the paths refer to the plan and the tables
    Simulation& operator=(const Simulation&) = delete;

    // Advances by parameters.frameTime. Runaway: check's, of the frame before; nothing moves then.
    void frame();
    // Waits for the last frame. Runaway: it, or one before it, left a state that is not finite or too fast.
    // That stays so until a restart or another state is loaded.
    void check() const;
    void restart();  // back to the start state, which is uploaded again

    Parameters parameters;
    const Plan& plan() const { return plan_; }
    const PathChoice& path() const { return choice_; }
    Lanes lanes(size_t group) const;  // fused: how the group's molecules are spread
    StateView state() const;
    size_t stateBytes() const;  // on the device
    double time() const { return time_; }
    int frames() const { return frames_; }
    gpu::PassTimers& timers() { return timers_; }
    gpu::Context& context() const { return *context_; }
    // Returns the contact of molecules with one another; null: there is none.
    const ContactResult* contact() const;
    // Counts a group with life. Waits; reads 128 bytes of control.
    LifeCounts lifeCounts(size_t group) const;
    // Other numbers for birth and death, from the next frame on. False, and nothing changes: what differs
    // needs another plan.
    bool changeLife(size_t group, const Lifecycle& life);
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
    // Reads one molecule, with its scale and phase in `looks`. Waits. On the fused path its whole block of
    // molecules crosses the bus.
    GroupState readMolecule(size_t group, size_t molecule) const;
    SavedState save() const;
    // Before the last frame, to look closer at what went wrong in it; nothing where it is gone: on the
    // ping-pong path, in place, where some are born or die or school, and without a frame since the last load
    // or restart.
    std::optional<SavedState> saveBefore() const;
    void load(const SavedState& saved);
    uint64_t hash() const;  // of the whole state's bits (FNV-1a): same scene, path and driver, same bits

  private:
    std::variant<std::monostate, PingPong, Fused> makePath(const std::string& shaderRoot,
                                                           const SimulationOptions& options);
    GroupState readGroup(size_t group) const;
    void writeGroup(size_t group, const GroupState& state, double time);
    void computeNormals();
    bool alarmed() const;
    void disarm();
    bool forcesJump() const;

    gpu::Context* context_;
    Plan plan_;
    PathChoice choice_;
    Tables tables_;
    bool drawn_, inPlace_ = false;
    std::vector<Warning> warnings_;
    gpu::PassTimers timers_;
    std::variant<std::monostate, PingPong, Fused> path_;
    double time_ = 0;  // s
    int frames_ = 0;
    double lastStep_ =
        0;  // s, a substep of the last frame; 0: none yet, or what it left behind does not count
    std::optional<Parameters> lastParameters_;  // of the last frame; none yet since the start or a load
    struct Moment {
        double time = 0, step = 0;  // s
        int frames = 0;
    };
    std::optional<Moment> before_;  // the start of the last frame; nothing: it is gone
};

}  // namespace shoal
