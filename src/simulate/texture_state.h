// The ping-pong path's state: float textures, shared by all groups, one texel a vertex, RGBA32F.
//
//   a state texture is 1024 texels wide; group g owns `rows` of them from `firstRow` on
//   vertex v of molecule m:   x = m mod 1024,  y = firstRow + v * slabRows + m / 1024
//   so vertex v of all molecules is a slab of whole rows, and neighbouring texels are neighbouring molecules
//
//   position       xyz relative to the molecule's anchor, m      (two sides, ping-pong)
//   velocity       xyz m/s                                       (two sides)
//   acceleration   xyz of the springs, m/s^2: leapfrog only      (two sides)
//   normal         xyz unit
//
// Records: molecule m of group g at x = m mod 1024, y = firstRecordRow + m / 1024
//   record         xyz anchor, m; w flags: 1 = pins released     (two sides)
//   constant       x seed (an integer below 2^24), y scale, z actuation phase offset (rad), w unused
#pragma once

#include <array>
#include <vector>

#include "compile/plan.h"
#include "gpu/context.h"
#include "gpu/framebuffer.h"
#include "gpu/texture.h"

namespace shoal {

namespace gpu {
class Program;
}

// Two textures, of which each group has its own current side: a group that did not step is never stale.
struct TwoSided {
    std::array<gpu::Texture, 2> side;
    std::vector<int> currentSide;  // per group

    gpu::Texture& current(size_t group) { return side[size_t(currentSide[group])]; }
    const gpu::Texture& read(size_t group) const { return side[size_t(currentSide[group])]; }
    const gpu::Texture& write(size_t group) const { return side[size_t(1 - currentSide[group])]; }
    void flip(size_t group) { currentSide[group] = 1 - currentSide[group]; }
    explicit operator bool() const { return bool(side[0]); }
};

class TextureState {
  public:
    // Borrows the plan. Error, located at the largest group: out of memory.
    TextureState(gpu::Context& context, const Plan& plan);

    // Where a group lies.
    struct Rows {
        int slabRows;        // of one vertex
        int firstRow, rows;  // in the state textures
        int firstRecordRow;  // in the record textures; slabRows of them
    };
    const Rows& rowsOf(size_t group) const { return rows_[group]; }
    // Sets it for shaders/state/textures.glsl.
    void setGroup(const gpu::Program& program, size_t group) const;

    // Into and from the current sides; counted as state that crosses the bus.
    void write(size_t group, const GroupState& state);
    GroupState read(size_t group) const;
    // Reads so many molecules. Their scales and phases are in `looks`.
    GroupState readSome(size_t group, size_t first, size_t count) const;
    std::vector<glm::vec3> readNormals(size_t group) const { return download(normal, group); }

    TwoSided position, velocity, acceleration, record;
    // Runge-Kutta methods: the state of a stage, and the rates added up so far; side s mod 2 is written by
    // stage s.
    std::array<gpu::Texture, 2> stagePosition, stageVelocity, sumVelocity, sumAcceleration;
    gpu::Texture normal, constant;

    // Framebuffer that draws into the given sides (made once per combination).
    const gpu::Framebuffer& target(const std::vector<gpu::ColorTarget>& colors) {
        return targets_.into(colors);
    }

  private:
    // Index = molecule * vertexCount + vertex.
    void upload(gpu::Texture& texture, size_t group, const std::vector<glm::vec3>& values) const;
    std::vector<glm::vec3> download(const gpu::Texture& texture, size_t group) const;

    const Plan* plan_;
    std::vector<Rows> rows_;  // per group
    gpu::Framebuffers targets_;
};

}  // namespace shoal
