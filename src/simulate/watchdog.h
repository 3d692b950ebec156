// The watchdog: a state that is not finite, or faster than anything that the equations are meant for, stops
// the run within a frame, and the state before it can still be saved.
//
// The GPU only notices: compute kernels look at what they store and write the frame's number into one word
// (shaders/fused/watch.glsl); fragment passes draw what is wrong inside an occlusion query
// (shaders/fused/watch.frag, shaders/passes/watch.frag). The next frame reads that, 4 bytes, before it
// begins: so the frame itself never waits, and the side of the state before the bad frame is still there.
// On a GPU the kernels of later frames change nothing once the word is set: so the CPU need not know before
// it issues them, and reads the word up to three frames late. Which vertex it was, the CPU finds in the
// states read back.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "core/error.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/gl.h"
#include "gpu/program.h"

namespace shoal {

struct GroupPlan;
struct GroupState;
struct Plan;
struct SavedState;

// Above this speed, m/s, a vertex has run away: a hundred times as fast as sound would be in these molecules.
constexpr double runawaySpeed = 1e4;
// Returns the define of shaders/physics/runaway.glsl: "FASTEST_SQUARED 1e8".
std::string fastestDefine();

// The vertex that ran away: the first that is not finite, else the fastest.
struct Alarm {
    size_t group = 0;
    int molecule = 0, vertex = 0;
    bool finite = true;
    bool cutShort = false;  // its loops ended early, which shaders mark (shaders/step/cut_short.glsl)
    double speed = 0;       // m/s, where finite
    double time = 0;        // s, of the state that it was found in
    int frame = 0;
};
Alarm findAlarm(const SavedState& state);
bool runsAway(const Alarm& alarm);

// Says which vertex ran away, when, and what may have caused it; located at the group.
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
    // Returns 0 where the last frame left a state that ran away, else none. Waits for the answer, 4 bytes.
    std::optional<int> framesSince() const;
    void disarm() { asked_ = false; }

  private:
    gpu::Handle<gpu::deleteQuery> query_;
    gpu::Traffic* traffic_;
    bool asked_ = false;
};

// The word that compute kernels set: 0, or 1 + the number of the frame that left a state which ran away.
class RunawayWord {
  public:
    enum class Reading {
        waits,  // for the last frame
        ahead,  // takes what has arrived; at most `mostBehind` frames are missing (OpenGL 4.4)
        late,   // for tests: so many frames are missing
    };
    static constexpr int mostBehind = 3;

    RunawayWord(gpu::Context& context, Reading reading);

    void bind(const gpu::Program& program) const { program.storage("Alarm", word_); }
    // Called after the kernels of a frame and a barrier for Buffer.
    void endFrame(int number);
    // Returns how many frames have been issued after the first one whose state ran away; 0 if that was the
    // last frame, none if no such frame is known.
    std::optional<int> framesSince(bool waits);
    void goBack(int frames) { last_ -= frames; }
    void disarm();

  private:
    using Fence = std::unique_ptr<std::remove_pointer_t<GLsync>, decltype([](GLsync s) { glDeleteSync(s); })>;

    uint32_t seen() const;

    gpu::Buffer word_;
    Reading reading_;
    gpu::Handle<gpu::deleteBuffer> copies_;
    const volatile uint32_t* copy_ = nullptr;  // mostBehind + 1 of them, as the device hands them over
    std::array<Fence, mostBehind + 1> fences_;
    size_t next_ = 0;      // of the copies: the oldest
    uint32_t raised_ = 0;  // the word as it was last read
    int last_ = 0;         // number of the last frame
    gpu::Traffic* traffic_;
};

// Takes the anchors and released pins of `state`, the side before the last frame, back to what they were
// then. The fused path has two sides of positions and velocities, but only one of anchors and pins, which a
// lane changes in place. An anchor moved by a shift that follows from vertex 0, and pins that had not been
// released were where they started, at rest.
void undoRecords(const GroupPlan& group, GroupState& state);

}  // namespace shoal
