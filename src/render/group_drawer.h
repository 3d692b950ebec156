// Draws one group, whatever it is made of: straight from the state of either path, many molecules an
// instanced draw. The state is read and nothing of it crosses the bus. DrawnGroups says when and in which
// order.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/lighting.h"
#include "render/scale_uniforms.h"
#include "render/slab_draws.h"
#include "render/view.h"
#include "simulate/state_view.h"

namespace shoal {

// The inputs of a picture besides the state. Borrows.
struct DrawInputs {
    const Eye& eye;
    const Lighting& lighting;
    const gpu::Texture* sceneDepth = nullptr;  // of all that is not blended, where a group asks for it
    bool multisampled = false;
};

class GroupDrawer {
  public:
    virtual ~GroupDrawer() = default;
    GroupDrawer(const GroupDrawer&) = delete;
    GroupDrawer& operator=(const GroupDrawer&) = delete;

    size_t index() const { return index_; }  // of the group in the plan
    int count() const { return count_; }
    const DrawStream& stream() const { return stream_; }
    virtual bool readsDepth() const { return false; }  // DrawInputs::sceneDepth

    // Adds the defines of the draw order to the programs of the picture, before the first is made.
    void addOrderDefines(const std::vector<std::string>& defines);

    // Colours by what the molecules do, before the first program is made.
    void colorBy(const ColorScale& scale, int vertexCount);

    // The program that draws into the picture or the shadow map: in use, all but the state set. `time`: s.
    virtual const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) = 0;
    virtual const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) = 0;
    // Binds the state and draws it: of the buffers, each part by itself.
    void submit(const gpu::Program& program, const StateView& state) const;
    void submitSlab(const gpu::Program& program, const StateView& state, const SlabDraws& draws,
                    int slab) const;

  protected:
    // One for textures, one for buffers; made when first drawn.
    using Variants = std::array<const gpu::Program*, 2>;

    // `programs`: shared by equal groups, borrowed.
    GroupDrawer(gpu::Context& context, const std::string& shaderRoot, gpu::Programs& programs,
                const GroupPlan& plan, size_t index);
    // In use, with what all groups have of the picture or the shadow map.
    const gpu::Program& beginLit(const StateView& state, const DrawInputs& inputs);
    const gpu::Program& beginDepth(const StateView& state, const ShadowMap& shadow);

    gpu::Context* context_;
    gpu::Programs* programs_;
    std::string shaderRoot_, name_;
    DrawStream stream_;
    gpu::VertexArray corners_;
    gpu::ProgramOptions litOptions_, depthOptions_;  // but for what the kind of the state adds
    Variants lit_{}, depth_{};
    std::vector<std::string> orderDefines_;
    std::optional<ScaleUniforms> scale_;  // none: the material's own colours

  private:
    const gpu::Program& program(Variants& variants, const gpu::ProgramOptions& options,
                                const StateView& state) const;
    void bind(const gpu::Program& program, const StateView& state, const GroupBuffers::Part* part,
              int count) const;

    size_t index_;
    int count_;
    glm::ivec4 rows_;
    BufferLayout layout_;
};

}  // namespace shoal
