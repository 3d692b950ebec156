// The watchdog: a state that is not finite, or faster than anything that the equations are meant for, stops
// the run within a frame, and the state before it can still be saved.
//
// The GPU only notices: the fused kernels look at what they store and set one word
// (shaders/fused/watch.glsl), the ping-pong path has a pass that draws what is wrong inside an occlusion
// query (shaders/passes/watch.frag). The next frame reads that, 4 bytes, before it begins: so the frame
// itself never waits, and the side of the state before the bad frame is still there. Which vertex it was, the
// CPU finds in the states read back.
#pragma once

#include <optional>
#include <string>

#include "core/error.h"

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
    double speed = 0;  // m/s, where finite
    double time = 0;   // s, of the state that it was found in
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

// The fused path has two sides of positions and velocities but one of anchors and released pins, which a lane
// changes in place. This takes those of `state`, the side before the last frame, back to what they were then:
// an anchor moved by a shift that follows from vertex 0, and pins that had not been released were where they
// started, at rest.
void undoRecords(const GroupPlan& group, GroupState& state);

}  // namespace shoal
