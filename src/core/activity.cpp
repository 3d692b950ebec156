#include "core/activity.h"

#include <mutex>
#include <utility>

namespace shoal {

namespace {

std::mutex guard;
std::string current;
std::chrono::steady_clock::time_point began;

}  // namespace

Activity::Activity(std::string what) {
    const std::lock_guard lock(guard);
    outer_ = std::exchange(current, std::move(what));
    outerBegan_ = std::exchange(began, std::chrono::steady_clock::now());
}

Activity::~Activity() {
    const std::lock_guard lock(guard);
    current = std::move(outer_);
    began = outerBegan_;
}

std::pair<std::string, double> activity() {
    const std::lock_guard lock(guard);
    return {current, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()};
}

}  // namespace shoal
