#include "simulate/places.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace shoal {

constexpr double freeSince = -std::numeric_limits<double>::infinity();

// A stack hands out the first places first.
Places::Places(Allocator allocator, size_t count)
    : allocator_(allocator), ends_(count, freeSince), free_(count) {
    std::iota(free_.begin(), free_.end(), uint32_t(0));
    if (allocator == Allocator::stack) std::reverse(free_.begin(), free_.end());
}

void Places::giveBack(uint32_t place) {
    ends_[place] = freeSince;
    free_.push_back(place);
    if (allocator_ == Allocator::heap) std::push_heap(free_.begin(), free_.end(), std::greater<>());
}

void Places::freeUntil(double time) {
    while (!next_.empty() && next_.top().first <= time) {
        giveBack(next_.top().second);
        next_.pop();
    }
    while (mark_ > 0 && ends_[size_t(mark_) - 1] == freeSince)
        --mark_;
}

bool Places::take(double end, uint32_t& place) {
    if (free_.empty()) return false;
    if (allocator_ == Allocator::heap) std::pop_heap(free_.begin(), free_.end(), std::greater<>());
    place = free_.back();
    free_.pop_back();
    ends_[place] = end;
    next_.emplace(end, place);
    mark_ = std::max(mark_, int(place) + 1);
    return true;
}

std::vector<uint32_t> Places::stack() const {
    if (allocator_ != Allocator::stack) return {};
    std::vector<uint32_t> out = free_;
    out.resize(ends_.size());
    return out;
}

void Places::restore(const std::vector<double>& ends, const std::vector<uint32_t>& stack, double time) {
    ends_ = ends;
    free_.clear();
    next_ = {};
    mark_ = 0;
    for (uint32_t place = 0; place < ends_.size(); ++place) {
        if (ends_[place] > time) {
            next_.emplace(ends_[place], place);
            mark_ = int(place) + 1;
        } else {
            ends_[place] = freeSince;
            free_.push_back(place);  // ascending: a heap as it is
        }
    }
    if (allocator_ != Allocator::stack) return;
    if (stack.size() == ends_.size())
        std::copy_n(stack.begin(), free_.size(), free_.begin());
    else
        std::reverse(free_.begin(), free_.end());
}

}  // namespace shoal
