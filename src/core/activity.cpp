#include "core/activity.h"

#include <mutex>
#include <utility>

namespace shoal {

using Clock = std::chrono::steady_clock;

namespace {

std::mutex guard;
Busy current;
Clock::time_point began;

}  // namespace

Activity::Activity(std::string what) {
    const std::lock_guard lock(guard);
    outer_ = std::exchange(current, Busy{std::move(what)});
    outerBegan_ = std::exchange(began, Clock::now());
}

Activity::~Activity() {
    const std::lock_guard lock(guard);
    current = std::move(outer_);
    began = outerBegan_;
}

void Activity::reach(double share) {
    const std::lock_guard lock(guard);
    current.share = share;
}

Busy activity() {
    const std::lock_guard lock(guard);
    Busy out = current;
    out.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    return out;
}

}  // namespace shoal
