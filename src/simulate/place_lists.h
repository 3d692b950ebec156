// Sets of places as bits on the GPU, and lists of them in ascending order: the same for the same bits. Three
// dispatches over the words: sums, their scan by one workgroup, the list (shaders/particles/bits_*.comp).
//
// The scan's results, and what births need of them, stay on the GPU in words of control, so many a group
// (shaders/particles/control.glsl).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "gpu/buffer.h"
#include "gpu/program.h"

namespace shoal {

namespace control {
constexpr int words = 32;  // a group
constexpr size_t live = 3, mark = 4, lost = 6, bornEver = 7, birthGroups = 8, stepGroups = 12;
}  // namespace control
// Emitters from deaths that a group may have: two textures of each, beside four of the group's own, of the
// 16 that any device has.
constexpr int mostDeathRuns = 6;

// Whose bits, where its control is, and with how many lanes a workgroup of its step works.
struct PlaceSet {
    int places = 0;
    size_t group = 0;
    int stepLanes = 64;
};

class PlaceLists {
  public:
    // For groups of a plan, of up to so many places.
    PlaceLists(gpu::Context& context, const std::string& shaderRoot, size_t groups, size_t mostPlaces,
               gpu::ProgramCache* cache);

    static size_t bytesOf(size_t places);  // of their bits

    // All set bits into `list` from word `at`, how many into control; the bits are cleared.
    void listDeaths(const PlaceSet& set, const gpu::Buffer& bits, const gpu::Buffer& list, size_t at);
    // How many of the births find a place among the set bits: `scheduled`, and for each of `deaths` (x: a
    // group's first word of control, y: births for each of its deaths). Only counts unless it `allocates`.
    void countPlaces(const PlaceSet& set, const gpu::Buffer& bits, int scheduled,
                     std::span<const glm::ivec4> deaths, bool allocates);
    // After countPlaces: the first of them, as many as are born; their bits are cleared.
    void listPlaces(const PlaceSet& set, const gpu::Buffer& bits, const gpu::Buffer& list);

    static size_t controlAt(size_t group) { return group * control::words; }
    const gpu::Buffer& control() const { return control_; }
    void readControl(size_t group, uint32_t* words) const;
    void writeControl(size_t group, const uint32_t* words);

  private:
    void sum(const PlaceSet& set, const gpu::Buffer& bits);
    void setUp(const gpu::Program& program, const PlaceSet& set) const;

    gpu::Program count_, scanDeaths_, scanPlaces_, listDeaths_, listPlaces_;
    gpu::Buffer control_, sums_;
};

// Before what reads by any means that births and their lists write.
void settleBirths();

}  // namespace shoal
