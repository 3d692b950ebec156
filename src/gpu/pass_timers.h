// How long each stage of a frame takes: passes that follow one another under one name. It is the name of its
// timer, of its debug group, of its row in the panel and of its passes in a record (gpu/frame_record.h); a
// call without passes does not count.
//
// A value is the seconds that all calls under one name took together in one frame. In query mode the results
// are read back a few frames later, when they are there, so that nothing waits; and a frame reads at most
// 4 + 24 * 8 = 196 bytes, which leaves 60 of the frame's 256 bytes of control to others: when there are more
// calls than 24, a window of 24 that moves on with every frame is timed and scaled to the number of calls.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "gpu/gl.h"

namespace shoal::gpu {

struct PassTime {
    std::string name;
    double last = 0, min = 0, median = 0;  // seconds a frame, over the frames that are kept
    int calls = 0;                         // in the last frame
    int frames = 0;                        // with a value so far
    std::vector<double> values = {};       // s, of the frames that are kept, oldest first
};

class PassTimers {
  public:
    enum class Mode {
        off,
        query,   // GL_TIME_ELAPSED: right for a GPU, costs next to nothing
        finish,  // glFinish and a clock: right for a CPU rasteriser, whose queries are not
    };
    static constexpr int queriesPerFrame = 24;
    static constexpr int keptFrames = 1024;  // of history, for each name

    PassTimers(Context& context, Mode mode);
    static Mode suitedTo(const ContextInfo& info);  // finish on a CPU rasteriser, else query
    Mode mode() const { return mode_; }
    void setMode(Mode mode);  // between frames

    class Scope {
      public:
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        friend class PassTimers;
        Scope(PassTimers& timers, const char* name);
        PassTimers& timers_;
        DebugGroup group_;
        std::string name_;
        uint64_t passesBefore_;
        bool open_ = false;  // inside a frame
        int call_ = -1;      // of this frame; -1: not timed
        std::chrono::steady_clock::time_point start_;
    };
    // auto t = timers.time("advect"); until the end of the block. Stages do not nest (a contract). Outside a
    // frame, and when off, this is a debug group only.
    [[nodiscard]] Scope time(const char* name) { return Scope(*this, name); }

    void beginFrame();
    void endFrame();
    void drain();  // query: waits for all results; for the end of a benchmark, not for frames
    void reset();  // forgets the history, such as after warming up

    std::vector<PassTime> report() const;  // in the order of first use

  private:
    struct Pass {
        std::string name;
        std::vector<double> values;  // a ring of keptFrames
        size_t written = 0;
        int calls = 0;  // in the last frame
    };
    struct Call {
        int pass = 0;
        int query = -1;  // index into the frame's queries
        double seconds = 0;
    };
    struct Frame {
        std::vector<Call> calls;
        std::vector<Handle<deleteQuery>> queries;
        int used = 0;
    };

    int passIndex(const std::string& name);
    bool sampled(int call) const;
    bool collectOldest(bool wait);
    void record(const std::vector<Call>& calls);

    const ContextInfo* info_;  // the context's, which outlives the timers and does not move
    Traffic* traffic_;
    Mode mode_;
    bool inFrame_ = false, inPass_ = false;
    std::vector<Pass> passes_;
    Frame frame_;
    std::deque<Frame> pending_;
    std::vector<Frame> spare_;
    int callsLastFrame_ = 0, windowStart_ = 0;
};

// The stages of frames, and after them those of their pictures; null: there are none. All that lists stages
// has them from here: run --timings, bench --report and the window.
std::vector<PassTime> stagesOf(const PassTimers& simulation, const PassTimers* drawing);

// The device's own time of what some calls ask of it, from two timestamps among its commands; waits for it.
// For benchmarks: without what the processor takes to issue them, as far as the driver hands them over
// together. On a CPU rasteriser the queries are not right.
class DeviceTimer {
  public:
    DeviceTimer() : begin_(glGenQueries), end_(glGenQueries) {}
    // Seconds.
    template <typename Work>
    double secondsOf(const Work& work) {
        glQueryCounter(begin_.id(), GL_TIMESTAMP);
        work();
        glQueryCounter(end_.id(), GL_TIMESTAMP);
        return elapsed();
    }

  private:
    double elapsed() const;

    Handle<deleteQuery> begin_, end_;
};

// How many points and triangles some draws make.
class PrimitiveCounter {
  public:
    PrimitiveCounter() : query_(glGenQueries) {}
    template <typename Work>
    void count(const Work& work) {
        glBeginQuery(GL_PRIMITIVES_GENERATED, query_.id());
        work();
        glEndQuery(GL_PRIMITIVES_GENERATED);
    }
    uint64_t last() const;  // of the last count(), for which it waits

  private:
    Handle<deleteQuery> query_;
};

// A frame of the timers until the end of the block: ended also where a program is refused, which is made when
// it is needed first.
class TimedFrame {
  public:
    explicit TimedFrame(PassTimers& timers) : timers_(timers) { timers_.beginFrame(); }
    ~TimedFrame();
    TimedFrame(const TimedFrame&) = delete;
    TimedFrame& operator=(const TimedFrame&) = delete;

  private:
    PassTimers& timers_;
};

}  // namespace shoal::gpu
