// Defines the head of a checkpoint: when, with which parameters, and of which scene it was saved. The layout
// is in simulate/checkpoint.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "compile/plan.h"
#include "simulate/step.h"

namespace shoal::checkpoint {

// FNV-1a over words of 8 bytes, mixed so that high bits reach low ones. Every step can be undone, so a
// difference in one word is never lost.
class Checksum {
  public:
    void add(const void* data, size_t bytes) {
        const char* from = static_cast<const char*>(data);
        for (; bytes > 0; from += 8) {
            uint64_t word = 0;
            const size_t part = std::min<size_t>(bytes, 8);
            std::memcpy(&word, from, part);
            bytes -= part;
            sum_ = (sum_ ^ word) * 1099511628211ull;
            sum_ ^= sum_ >> 32;
        }
    }
    template <typename T>
    void add(const T& value) {
        static_assert(std::is_arithmetic_v<T>);
        add(&value, sizeof value);
    }
    uint64_t sum() const { return sum_; }

  private:
    uint64_t sum_ = 14695981039346656037ull;
};

constexpr int32_t keepsHistory = 1, keepsSteering = 2;

// The numbers of parameters that a file holds, in its order; those of a Parameters, const or not.
template <typename P>
auto numbersOf(P& p) {
    return std::array{&p.gravity.x, &p.gravity.y, &p.gravity.z, &p.wind,
                      &p.drag,      &p.stiffness, &p.damping,   &p.frameTime};
}

struct GroupHead {
    std::string name;
    int32_t count = 0, vertexCount = 0, springCount = 0;
    uint64_t shape = 0, instances = 0;
    int32_t keeps = 0;  // the solver's memory of its last substep; what steers: never compared
};

struct Head {
    double time = 0, step = 0;  // s; 0: there is no last substep
    uint64_t forces = 0;        // forcesAt
    int32_t frames = 0;
    Parameters parameters, own;  // as they stood; as the scene had them
    std::vector<GroupHead> groups;
    // The memory of contacts has so many spheres, contacts, and texels of colliders of all spheres.
    uint64_t spheres = 0, contacts = 0, walls = 0;
};

std::vector<GroupHead> groupsOf(const Plan& plan);
// A fingerprint of all that acts on molecules at a time, beside the sliders: a solver with history goes on
// only under the same.
uint64_t forcesAt(const Plan& plan, double time);
// Says for people how the scene differs from the one that was saved; empty where it does not.
std::string difference(const std::vector<GroupHead>& saved, const std::vector<GroupHead>& here);

std::string pack(const Head& head);
// Error, located: they are no head.
Head unpack(const std::string& bytes, const Location& location);

}  // namespace shoal::checkpoint
