// The state of the fused step in fragments: float textures, a set for each group, packed as
// shaders/fused/state.glsl says.
//
//   an array texture is 1024 texels wide: 4-vector e of molecule m lies in layer e at (m mod 1024, m / 1024)
//
//   state     positions, then velocities (then the last changes of both), 3 floats a vertex    (two sides)
//   record    xyz anchor, m; w: 1 + seed, negative once pins are released    (two sides where it changes)
//   constant  x scale, y phase, rad; only where instances differ
//   normal    3 floats a vertex, unit; only where something is drawn
//   steering  as shaders/fused/steering.glsl says, only where they steer    (two sides)
//
// Texels past the last molecule, up to the end of its row, do what it does.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "gpu/framebuffer.h"
#include "gpu/texture.h"
#include "simulate/packed_state.h"

namespace shoal {

// A draw into as many layers at once as there are colour targets.
struct LayerDraw {
    int first;  // of what it stores (drawsOf in simulate/fused_kernel.h)
    gpu::Framebuffer target;
};

class GroupLayers : public PackedState {
  public:
    // A draw writes at most so many `targets`.
    // Error: out of memory; says of which group and how much it would take.
    GroupLayers(gpu::Context& context, const GroupPlan& group, bool normals, int targets);

    const gpu::Texture& state() const { return state_[size_t(current_)]; }
    const gpu::Texture& stateBefore() const { return state_[size_t(1 - current_)]; }
    const gpu::Texture& records() const { return records_[records_[1] ? size_t(current_) : 0]; }
    const gpu::Texture& constants() const { return constants_; }
    const gpu::Texture& normals() const { return normals_; }
    // Where molecules are born, one for each draw of births: into the side that was written last.
    const std::vector<LayerDraw>& newborns() const { return newborns_[size_t(current_)]; }
    std::vector<MoleculeRange> ranges() const override { return {{0, count_}}; }
    void bindRead(const gpu::Program& program, size_t) const override;
    void run(const gpu::Program& program, size_t, Output output) const override {
        draw(program, output, count_, 3);
    }
    // Draws the rows of so many molecules, as one triangle or what the vertex shader makes of more vertices.
    void draw(const gpu::Program& program, Output output, int molecules, int vertices) const;
    void flip() override { current_ = 1 - current_; }
    bool hasBefore() const override { return true; }
    // What steers them, where they steer; one draw writes its other side.
    const gpu::Texture& steering() const { return steering_[size_t(steeringNow_)]; }
    const gpu::Framebuffer& newSteering() const { return newSteering_[size_t(steeringNow_)]; }
    void flipSteering() { steeringNow_ = 1 - steeringNow_; }

    bool hasConstants() const override { return bool(constants_); }
    bool hasNormals() const override { return bool(normals_); }

  private:
    template <typename Self>
    static auto& textureOf(Self& self, Values values);
    bool hasSteering() const override { return bool(steering_[0]); }
    void upload(Values values, size_t first, const std::vector<glm::vec4>& packed) override;
    std::vector<glm::vec4> download(Values values) const override;
    std::vector<glm::vec4> download(Values values, size_t first, size_t count) const override;

    int count_;
    int current_ = 0;
    int steeringNow_ = 0;
    std::array<gpu::Texture, 2> state_, records_, steering_;
    gpu::Texture constants_, normals_;
    std::array<std::vector<LayerDraw>, 2> newState_, newborns_;  // one for each draw, from this side
    std::vector<LayerDraw> newNormals_;
    std::array<gpu::Framebuffer, 2> newSteering_;
};

}  // namespace shoal
