// An execution path holds the state of a plan and moves it, as a Simulation asks: `Fused` (in
// compute shaders of OpenGL 4.3, or in fragments of 3.3) or `PingPong` (OpenGL 3.3). What a path does not
// have it answers with nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "compile/path.h"
#include "gpu/pass_timers.h"
#include "simulate/contact/memory.h"

namespace shoal {

struct Frame;
struct StateView;

struct SimulationOptions {
    // Normals are computed at the end of each frame, for the renderer and for exports.
    bool drawn = true;
    gpu::PassTimers::Mode timing = gpu::PassTimers::Mode::off;
    Path path = Path::automatic;
    bool inPlace = false;            // fused: half the memory of the state
    Lanes lanes = Lanes::automatic;  // fused: how molecules are spread
    bool watchdog = true;            // simulate/watchdog.h
    // Fused, for tests: contact takes the passes that suit a GPU, or a CPU rasteriser, whatever the context
    // is; both give the same bits. For a GPU, a state that ran away is noticed as late as it may be.
    std::optional<bool> asOnGpu = std::nullopt;
    // Fused, for tests: a dispatch takes at most so many molecules or newborns, as on a device of small
    // blocks; 0: as many as this one takes.
    size_t largestPart = 0;
};

// How the iterations of a contact step ended.
struct ContactConvergence {
    int iterations = 0;             // that ran
    std::optional<float> residual;  // that they left; nothing is known of a single one, or without gravity
};

// Gives tests, benchmarks and reports the results of contact between molecules.
class ContactResult {
  public:
    virtual ~ContactResult() = default;
    // Contacts that were left out, of all steps so far, because a sphere touched more than a list holds.
    virtual uint32_t dropped() const = 0;
    // Of the last step. Reads back.
    virtual ContactConvergence convergence() const = 0;
    // Contacts that the last step found, as numbers of spheres (compile/contact_plan.h), the smaller first,
    // ascending. For tests and reports: reads the lists back.
    virtual std::vector<std::pair<int, int>> found() const = 0;
    virtual int listLength() const = 0;        // contacts that one sphere may have
    virtual ContactMemory memory() const = 0;  // empty: nothing is remembered
    virtual size_t bytes() const = 0;          // on the device
    // Dispatches of the last step, those without a workgroup among them; 0 in fragments.
    virtual int dispatches() const { return 0; }
};

struct LifeCounts {
    int capacity = 0;
    int live = 0;       // taken places
    int mark = 0;       // one past the last of them: as far as a step reaches
    uint64_t born = 0;  // so far
    uint64_t lost = 0;  // so far: births that found no place; allocator ring: lives that a birth cut short
};

class ExecutionPath {
  public:
    virtual ~ExecutionPath() = default;

    virtual void step(const Frame& frame, gpu::PassTimers& timers) = 0;
    virtual void computeNormals(gpu::PassTimers& timers) = 0;  // of the state as it is, where drawn
    virtual StateView view() const = 0;

    // State bytes are counted as they cross the bus. `time`: of the state, s.
    virtual void write(size_t group, const GroupState& groupState, double time) = 0;
    virtual GroupState read(size_t group) const = 0;
    // Reads so many molecules, with their scales and phases in `looks`, and little beside them.
    virtual GroupState readSome(size_t group, size_t first, size_t count) const = 0;
    virtual std::vector<glm::vec3> readNormals(size_t group) const = 0;
    // Takes back what memory() has given for as many spheres, or empties the memory of contacts.
    virtual void remember(const ContactMemory&) {}
    // The groups before the last frame; nothing where they are gone.
    virtual std::optional<std::vector<GroupState>> readBefore() const { return {}; }

    // Returns how many frames have been issued after the first since disarm() whose state ran away; 0 if that
    // was the last frame. They have changed nothing, and goBack() takes them back. Returns none if no such
    // frame is known, without waiting or, where it `waits`, up to the last frame. Reads 4 bytes.
    virtual std::optional<int> framesSinceAlarm(bool waits) = 0;
    virtual void goBack(int) {}
    virtual void disarm() = 0;

    virtual const ContactResult* contact() const = 0;  // null: there is none
    virtual Lanes lanes(size_t) const { return Lanes::automatic; }
    virtual LifeCounts lifeCounts(size_t) const { return {}; }
    // These change a group's numbers from the next frame on. They return false, and change nothing, where the
    // group has none of the kind or what differs needs another plan.
    virtual bool changeLife(size_t, const Lifecycle&) { return false; }
    virtual bool changeSchool(size_t, const School&) { return false; }
};

}  // namespace shoal
