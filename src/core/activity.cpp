#include "core/activity.h"

#include <mutex>
#include <utility>

namespace shoal {

namespace {

std::mutex guard;
std::string current;

}  // namespace

Activity::Activity(std::string what) {
    const std::lock_guard lock(guard);
    outer_ = std::exchange(current, std::move(what));
}

Activity::~Activity() {
    const std::lock_guard lock(guard);
    current = std::move(outer_);
}

std::string activity() {
    const std::lock_guard lock(guard);
    return current;
}

}  // namespace shoal
