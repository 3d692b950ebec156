#include "gpu/pass_timers.h"

#include <algorithm>

#include "core/contract.h"
#include "gpu/frame_record.h"
#include "gpu/program.h"

namespace shoal::gpu {

// Frames whose results have not arrived yet. Above this, frames go untimed instead of piling up.
static constexpr size_t pendingFrames = 6;
static_assert(4 + 8 * PassTimers::queriesPerFrame <= Traffic::controlBytesPerFrame);

PassTimers::PassTimers(Context& context, Mode mode)
    : info_(&context.info()), traffic_(&context.traffic()), mode_(mode) {}

PassTimers::Mode PassTimers::suitedTo(const ContextInfo& info) {
    return info.software ? Mode::finish : Mode::query;
}

void PassTimers::setMode(Mode mode) {
    drain();
    mode_ = mode;
}

PassTimers::Scope::Scope(PassTimers& timers, const char* name)
    : timers_(timers), group_(*timers.info_, name), name_(name), passesBefore_(FrameRecord::passes()) {
    FrameRecord::enter(name);
    if (!timers.inFrame_) return;
    EXPECTS(!timers.inPass_ && "stages do not nest");
    timers.inPass_ = true;
    open_ = true;
    if (timers.mode_ == Mode::off) return;
    Frame& frame = timers.frame_;
    call_ = static_cast<int>(frame.calls.size());
    frame.calls.emplace_back();
    if (timers.mode_ == Mode::finish) {
        glFinish();
        start_ = std::chrono::steady_clock::now();
    } else if (timers.sampled(call_)) {
        if (frame.used == static_cast<int>(frame.queries.size())) frame.queries.emplace_back(glGenQueries);
        frame.calls.back().query = frame.used++;
        glBeginQuery(GL_TIME_ELAPSED, frame.queries[static_cast<size_t>(frame.calls.back().query)].id());
    }
}

PassTimers::Scope::~Scope() {
    FrameRecord::enter("");
    if (!open_) return;
    timers_.inPass_ = false;
    if (call_ < 0) return;
    Frame& frame = timers_.frame_;
    Call& call = frame.calls[static_cast<size_t>(call_)];
    if (timers_.mode_ == Mode::finish) {
        glFinish();
        call.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    } else if (call.query >= 0) {
        glEndQuery(GL_TIME_ELAPSED);
    }
    if (FrameRecord::passes() != passesBefore_) {
        call.pass = timers_.passIndex(name_);
        return;
    }
    if (call.query >= 0) --frame.used;
    frame.calls.pop_back();
}

// A frame has about as many calls as the one before: the window lies in those, and wraps around.
bool PassTimers::sampled(int call) const {
    if (pending_.size() >= pendingFrames || frame_.used >= queriesPerFrame) return false;
    if (callsLastFrame_ <= queriesPerFrame) return true;
    const int fromStart = (call - windowStart_ % callsLastFrame_ + callsLastFrame_) % callsLastFrame_;
    return fromStart < queriesPerFrame;
}

int PassTimers::passIndex(const std::string& name) {
    const auto found =
        std::find_if(passes_.begin(), passes_.end(), [&](const Pass& pass) { return pass.name == name; });
    if (found != passes_.end()) return static_cast<int>(found - passes_.begin());
    passes_.emplace_back().name = name;
    return static_cast<int>(passes_.size()) - 1;
}

void PassTimers::beginFrame() {
    EXPECTS(!inFrame_);
    inFrame_ = true;
    if (mode_ == Mode::query) collectOldest(false);
}

void PassTimers::endFrame() {
    EXPECTS(inFrame_ && !inPass_);
    inFrame_ = false;
    for (Pass& pass : passes_)
        pass.calls = 0;
    for (const Call& call : frame_.calls)
        ++passes_[static_cast<size_t>(call.pass)].calls;
    callsLastFrame_ = static_cast<int>(frame_.calls.size());
    windowStart_ = callsLastFrame_ > 0 ? (windowStart_ + queriesPerFrame) % callsLastFrame_ : 0;
    if (mode_ == Mode::finish) record(frame_.calls);
    if (frame_.used > 0) {
        pending_.push_back(std::move(frame_));
        frame_ = Frame{};
        if (!spare_.empty()) {
            frame_ = std::move(spare_.back());
            spare_.pop_back();
        }
    }
    frame_.calls.clear();
    frame_.used = 0;
}

// At most one frame's results a frame. Queries of one kind finish in their order, so that the last one
// speaks for all.
bool PassTimers::collectOldest(bool wait) {
    if (pending_.empty()) return false;
    Frame& frame = pending_.front();
    GLuint ready = GL_TRUE;
    if (!wait) {
        glGetQueryObjectuiv(frame.queries[static_cast<size_t>(frame.used) - 1].id(),
                            GL_QUERY_RESULT_AVAILABLE, &ready);
        traffic_->countReadBack(Traffic::Kind::control, sizeof ready);
    }
    if (ready == GL_FALSE) return false;
    for (Call& call : frame.calls) {
        if (call.query < 0) continue;
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(frame.queries[static_cast<size_t>(call.query)].id(), GL_QUERY_RESULT,
                              &nanoseconds);
        traffic_->countReadBack(Traffic::Kind::control, sizeof nanoseconds);
        call.seconds = double(nanoseconds) * 1e-9;
    }
    record(frame.calls);
    spare_.push_back(std::move(frame));
    pending_.pop_front();
    return true;
}

// Adds up the calls of a frame by name, and scales to all of them where only some were timed.
void PassTimers::record(const std::vector<Call>& calls) {
    struct Sum {
        double seconds = 0;
        int calls = 0, timed = 0;
    };
    std::vector<Sum> sums(passes_.size());
    for (const Call& call : calls) {
        Sum& sum = sums[static_cast<size_t>(call.pass)];
        ++sum.calls;
        if (mode_ == Mode::query && call.query < 0) continue;
        ++sum.timed;
        sum.seconds += call.seconds;
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        if (sums[i].timed == 0) continue;
        const double value = sums[i].seconds * sums[i].calls / sums[i].timed;
        Pass& pass = passes_[i];
        if (pass.values.size() < keptFrames) {
            pass.values.push_back(value);
        } else {
            pass.values[pass.written % keptFrames] = value;
        }
        ++pass.written;
    }
}

double DeviceTimer::elapsed() const {
    GLuint64 begin = 0, end = 0;
    glGetQueryObjectui64v(begin_.id(), GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(end_.id(), GL_QUERY_RESULT, &end);
    return double(end - begin) * 1e-9;
}

uint64_t PrimitiveCounter::last() const {
    GLuint64 count = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &count);
    return count;
}

void PassTimers::drain() {
    EXPECTS(!inFrame_);
    while (collectOldest(true)) {
    }
}

void PassTimers::reset() {
    EXPECTS(!inFrame_);
    drain();
    for (Pass& pass : passes_) {
        pass.values.clear();
        pass.written = 0;
        pass.calls = 0;
    }
}

std::vector<PassTime> PassTimers::report() const {
    std::vector<PassTime> out;
    for (const Pass& pass : passes_) {
        PassTime time;
        time.name = pass.name;
        time.calls = pass.calls;
        time.frames = static_cast<int>(pass.written);
        time.values = pass.values;
        if (pass.written > keptFrames)
            std::rotate(time.values.begin(),
                        time.values.begin() + static_cast<std::ptrdiff_t>(pass.written % keptFrames),
                        time.values.end());
        if (!pass.values.empty()) {
            time.last = time.values.back();
            std::vector<double> sorted = pass.values;
            std::sort(sorted.begin(), sorted.end());
            time.min = sorted.front();
            const size_t middle = sorted.size() / 2;
            time.median =
                sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
        }
        out.push_back(std::move(time));
    }
    return out;
}

std::vector<PassTime> stagesOf(const PassTimers& simulation, const PassTimers* drawing) {
    std::vector<PassTime> out = simulation.report();
    if (drawing)
        for (PassTime& stage : drawing->report())
            out.push_back(std::move(stage));
    return out;
}

TimedFrame::~TimedFrame() {
    timers_.endFrame();
    endFirstUse();
}

}  // namespace shoal::gpu
