// The free places of a group with life where the CPU knows them: allocators stack and heap.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "scene/emitter.h"

namespace shoal {

// The allocators on the CPU [Latta 2004, section 3.4.1]: which places are free, known from when what is in
// them dies of age. What dies earlier keeps its place until then.
class Places {
  public:
    Places() = default;
    // `allocator`: stack or heap.
    Places(Allocator allocator, size_t count);

    // Frees the places whose lives end by this time.
    void freeUntil(double time);
    // Takes a place until `end`. Returns false where none is free.
    bool take(double end, uint32_t& place);
    int mark() const { return mark_; }  // one past the last taken place
    size_t taken() const { return ends_.size() - free_.size(); }

    // These read and restore all of the state, to go on from.
    const std::vector<double>& ends() const { return ends_; }  // of each place, s; free: not above now
    std::vector<uint32_t> stack() const;                       // empty for a heap
    void restore(const std::vector<double>& ends, const std::vector<uint32_t>& stack, double time);

  private:
    void giveBack(uint32_t place);

    Allocator allocator_ = Allocator::heap;
    std::vector<double> ends_;
    std::vector<uint32_t> free_;  // a stack, or a binary heap with the smallest on top
    using End = std::pair<double, uint32_t>;
    std::priority_queue<End, std::vector<End>, std::greater<>> next_;  // to be freed
    int mark_ = 0;
};

}  // namespace shoal
