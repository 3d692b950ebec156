// The free places of a group with life: known on the CPU (allocators stack and heap), or as bits on the
// GPU.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "scene/emitter.h"

namespace shoal {

// The allocators on the CPU [Latta 2004, section 3.4.1]: which places are free, known from when what is in
// them dies of age. What dies earlier keeps its place until then.
class Places {
  public:
    Places() = default;
    // `allocator`: stack or heap.
    Places(Allocator allocator, size_t count);

    // Frees what ends by this time.
    void freeUntil(double time);
    // A place until `end`; false: there is none.
    bool take(double end, uint32_t& place);
    int mark() const { return mark_; }  // one past the last taken place
    size_t taken() const { return ends_.size() - free_.size(); }

    // All of it, to go on from.
    const std::vector<double>& ends() const { return ends_; }  // of each place, s; free: not above now
    std::vector<uint32_t> stack() const;                       // empty for a heap
    void restore(const std::vector<double>& ends, const std::vector<uint32_t>& stack, double now);

  private:
    void giveBack(uint32_t place);

    Allocator allocator_ = Allocator::heap;
    std::vector<double> ends_;
    std::vector<uint32_t> free_;  // a stack, or a binary heap with the smallest on top
    using End = std::pair<double, uint32_t>;
    std::priority_queue<End, std::vector<End>, std::greater<>> next_;  // to be freed
    int mark_ = 0;
};

// As many as the largest group with life has.
int mostPlaces(const Plan& plan);

namespace control {
constexpr int words = 32;  // a group
constexpr size_t of(size_t group) {
    return group * words;
}
constexpr int mostGroups = 65535;  // that any device takes in one direction of a dispatch
constexpr size_t live = 3, mark = 4, lost = 6, bornEver = 7, birthGroups = 8;
}  // namespace control
// Emitters from deaths that a group may have: two textures of each, beside four of the group's own, of the
// 16 that any device has.
constexpr int mostDeathRuns = 6;

// Says whose bits these are, where its control is, and how its step goes over the parts of its state.
struct PlaceSet {
    int places = 0;
    size_t group = 0;
    int stepLanes = 64;  // molecules that a workgroup of the step takes
    int partPlaces = 0, partCount = 1;
    const gpu::Buffer* stepGroups = nullptr;  // workgroups of the step of each part, x y z and one unused
};
// A range of a list, in words.
struct ListRange {
    size_t first = 0, count = 0;
};

// Sets of places as bits on the GPU, and lists of them in ascending order: the same for the same bits. Three
// dispatches over the words: sums, their scan by one workgroup, the list (shaders/births/bits_*.comp).
//
// The scan's results, and what births need of them, stay on the GPU in words of control, so many a group
// (shaders/births/control.glsl).
class PlaceLists {
  public:
    // For groups of a plan, of up to so many places.
    PlaceLists(gpu::Context& context, size_t groups, size_t mostPlaces);

    static size_t bytesOf(size_t places);  // of their bits

    // All set bits into `list` from word `at`, how many into control; the bits are cleared. `ranges`: of
    // what is listed, one after another, as long as a storage block holds.
    void listDeaths(const PlaceSet& set, const gpu::Buffer& bits, const gpu::Buffer& list, size_t at,
                    std::span<const ListRange> ranges);
    // How many of the births find a place among the set bits: `scheduled`, and for each of `deaths` (x: a
    // group's first word of control, y: births for each of its deaths). Only counts unless it `allocates`.
    void countPlaces(const PlaceSet& set, const gpu::Buffer& bits, int scheduled,
                     std::span<const glm::ivec4> deaths, bool allocates);
    // After countPlaces: the first of them, as many as are born; their bits are cleared.
    void listPlaces(const PlaceSet& set, const gpu::Buffer& bits, const gpu::Buffer& list,
                    std::span<const ListRange> ranges);

    const gpu::Buffer& control() const { return control_; }
    void readControl(size_t group, uint32_t* words) const;
    void writeControl(size_t group, const uint32_t* words);

  private:
    void sum(const PlaceSet& set, const gpu::Buffer& bits);
    void setUp(const gpu::Program& program, const PlaceSet& set) const;
    void setReach(const gpu::Program& program, const PlaceSet& set) const;
    void writeList(const gpu::Program& program, const PlaceSet& set, const gpu::Buffer& bits,
                   const gpu::Buffer& list, size_t at, std::span<const ListRange> ranges) const;

    gpu::Program count_, scanDeaths_, scanPlaces_, listDeaths_, listPlaces_;
    gpu::Buffer control_, sums_;
};

// Before what reads by any means that births and their lists write.
void settleBirths();

}  // namespace shoal
