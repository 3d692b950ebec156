// The free places of groups with life, and those in which one died, on the GPU without compute shaders: as
// bits in a texture, read from the state, and sums over them in the levels of a tree, each a draw
// (shaders/births/bits.frag, sums.frag). Down the tree a place is found by its rank, so lists of them are
// in ascending order (list.frag).
//
// The part that births need of the sums stays on the GPU in words of control, so many a group, four a texel
// (control.frag).
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "simulate/layer_state.h"
#include "simulate/places.h"

namespace shoal {

class TexturePlaces {
  public:
    // Borrows the plan. Error: out of memory.
    TexturePlaces(gpu::Context& context, const Plan& plan);

    // Sums over the places of a group after a step: so many from the first one on, around the capacity. What
    // follows is of these sums, and of this group.
    void sum(size_t group, const GroupLayers& state, int first, int count);
    // These draw the group's words of control: how many died; how many of the summed places are taken, which
    // a birth cuts short; how many of the births find a place: `scheduled`, and for each of `deaths` (x: a
    // group's first word of control, y: births for each of its deaths). It only counts unless it `allocates`.
    void putDeaths() { put(deaths_, 0, {}, false); }
    void putCuts() { put(cuts_, 0, {}, false); }
    void putBirths(int scheduled, std::span<const glm::ivec4> deaths, bool allocates) {
        put(births_, scheduled, deaths, allocates);
    }
    // These draw lists into rows of stateWidth texels: the places in which one died, and the free ones of
    // those who are born.
    void listDeaths(const gpu::Framebuffer& list, int firstRow, int rows) const {
        draw(listDeaths_, list, firstRow, rows);
    }
    void listPlaces(const gpu::Framebuffer& list, int rows) const { draw(listPlaces_, list, 0, rows); }

    const gpu::Texture& control() const { return control_[now_]; }
    void readControl(size_t group, uint32_t* words) const;
    void writeControl(size_t group, const std::vector<uint32_t>& words);

  private:
    struct Level {
        gpu::Texture sums;
        gpu::Framebuffer framebuffer;
    };
    void makePrograms(const Plan& plan);
    void put(const gpu::Program& program, int scheduled, std::span<const glm::ivec4> deaths, bool allocates);
    void draw(const gpu::Program& list, const gpu::Framebuffer& target, int firstRow, int rows) const;
    void bindTree(const gpu::Program& program) const;

    gpu::Context* context_;
    gpu::Texture bits_;
    gpu::Framebuffer newBits_;
    std::vector<Level> levels_;
    std::array<gpu::Texture, 2> control_;
    std::array<gpu::Framebuffer, 2> newControl_;  // into the other side
    size_t now_ = 0;
    gpu::Programs made_;
    std::vector<const gpu::Program*> findBits_;  // of each group; null: without life
    gpu::Program sumWords_, sumLevel_, deaths_, cuts_, births_, listDeaths_, listPlaces_;
    size_t group_ = 0;  // of the sums
    int count_ = 0;
};

}  // namespace shoal
