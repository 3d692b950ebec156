// The watchdog: a state that is not finite, or faster than anything that the equations are meant for, stops
// the run within a frame, and the state before it can still be saved.
//
// The GPU only notices: compute kernels look at what they store and set one word
// (shaders/fused/watch.glsl); fragment passes draw what is wrong inside an occlusion query
// (shaders/fused/watch.frag, shaders/passes/watch.frag). The next frame reads that, 4 bytes, before it
// begins: so the frame itself never waits, and the side of the state before the bad frame is still there.
// Which vertex it was, the CPU finds in the states read back.
#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal {

struct GroupPlan;
struct GroupState;
struct Plan;
struct SavedState;

// m/s. Above it a vertex has run away: a hundred times as fast as sound would be in these molecules.
constexpr double runawaySpeed = 1e4;
// For shaders/physics/runaway.glsl: "FASTEST_SQUARED 1e8".
std::string fastestDefine();

// The vertex that ran away: the first that is not finite, else the fastest.
struct Alarm {
    size_t group = 0;
    int molecule = 0, vertex = 0;
    bool finite = true;
    bool cutShort = false;  // by a rasteriser that leaves loops (gpu::mostSoftwareTurns), which shaders mark
    double speed = 0;       // m/s, where finite
    double time = 0;        // s, of the state that it was found in
    int frame = 0;
};
Alarm findAlarm(const SavedState& state);
bool runsAway(const Alarm& alarm);

// Who, when, and what may have caused it; located at the group.
class Runaway : public Error {
  public:
    Runaway(const Plan& plan, const Alarm& alarm);
    const Alarm& alarm() const { return alarm_; }

  private:
    Alarm alarm_;
};

// Asks, inside an occlusion query, whether passes leave anything that is not discarded. The answer is read
// later, so that nobody waits for it.
class RunawayQuery {
  public:
    explicit RunawayQuery(gpu::Traffic& traffic);

    // Passes that are drawn while it lives change no colours and are asked.
    class Asking {
      public:
        explicit Asking(RunawayQuery& query);
        Asking(const Asking&) = delete;
        Asking& operator=(const Asking&) = delete;
        ~Asking();
    };
    bool raised() const;  // waits for the answer, 4 bytes
    void disarm() { asked_ = false; }

  private:
    gpu::Handle<gpu::deleteQuery> query_;
    gpu::Traffic* traffic_;
    bool asked_ = false;
};

// Takes the anchors and released pins of `state`, the side before the last frame, back to what they were
// then. The fused path has two sides of positions and velocities, but only one of anchors and pins, which a
// lane changes in place. An anchor moved by a shift that follows from vertex 0, and pins that had not been
// released were where they started, at rest.
void undoRecords(const GroupPlan& group, GroupState& state);

}  // namespace shoal
