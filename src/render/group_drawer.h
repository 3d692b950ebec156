// Draws one group, of molecules or of particles: straight from the state of any path, many molecules an
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
#include "render/draw_order.h"
#include "render/lighting.h"
#include "render/view.h"
#include "scene/color_scale.h"
#include "scene/particle.h"
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

    size_t index() const { return reader_.index; }  // of the group in the plan
    const std::string& groupName() const { return name_; }
    int count() const { return count_; }
    // All that is drawn of a molecule, and then coarser and coarser levels of it.
    const std::vector<DrawStream>& streams() const { return streams_; }
    virtual bool readsDepth() const { return false; }  // DrawInputs::sceneDepth

    // Adds the defines of the draw order to the programs of the picture, before the first is made.
    void addOrderDefines(const std::vector<std::string>& defines);
    // Draws without an order from now on.
    void dropOrder();

    // Colours by what the molecules do, before the first program is made.
    void colorBy(const ColorScale& scale) { scale_ = scale; }

    // The program that draws into the picture or the shadow map: in use, all but the state set. `time`: s.
    virtual const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) = 0;
    virtual const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) = 0;
    // Binds the state and draws it: of the buffers, each part by itself. `level`: of streams().
    void submit(const gpu::Program& program, const StateView& state, size_t level = 0) const;
    void submitSlab(const gpu::Program& program, const StateView& state, const SlabDraws& draws,
                    int slab) const;

  protected:
    // For shaders/render/blend.glsl.
    static std::string blendDefine(Blend blend) { return concat("BLEND ", name(blend), "Blend"); }
    // One for textures, one for buffers; made when first drawn.
    using Variants = std::array<const gpu::Program*, StateView::forms>;

    // `programs`: shared by equal groups, borrowed.
    GroupDrawer(gpu::Context& context, gpu::Programs& programs, const GroupPlan& plan, size_t index);
    // In use, with what all groups have of the picture or the shadow map.
    const gpu::Program& beginLit(const StateView& state, const DrawInputs& inputs);
    const gpu::Program& beginDepth(const StateView& state, const ShadowMap& shadow);

    gpu::Context* context_;
    gpu::Programs* programs_;
    std::string name_;
    std::vector<DrawStream> streams_{1};
    gpu::VertexArray corners_;
    gpu::ProgramOptions litOptions_, depthOptions_;  // but for what the kind of the state adds
    Variants lit_{}, depth_{};
    std::vector<std::string> orderDefines_;
    std::optional<ColorScale> scale_;  // none: the material's own colours

  private:
    const gpu::Program& program(Variants& variants, const gpu::ProgramOptions& options,
                                const StateView& state) const;
    void bind(const gpu::Program& program, const StateView& state, const GroupBuffers::Part* part,
              int count) const;
    void setScale(const gpu::Program& program) const;

    StateReader reader_;
    int count_, vertexCount_;
};

// A group of molecules: gl_InstanceID is the molecule, gl_VertexID its vertex. Their triangles, two-sided and
// cut out of an image by its alpha, or those of its skin; without triangles each vertex as a round sprite.
class MoleculeDrawer : public GroupDrawer {
  public:
    // `plan` at `index` of the plan. Error: the image of the material is missing or not a PNG.
    MoleculeDrawer(gpu::Context& context, gpu::Programs& programs, const Group& group, const GroupPlan& plan,
                   size_t index, const Lighting& lighting);

    const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) override;
    const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) override;

    // Other colours, roughness, translucency and opacity; the rest of the group is as before.
    bool change(const Group& group);

  private:
    template <typename Vertices>
    void makeCorners(const Vertices& vertices, const std::vector<uint32_t>& indices);
    void makeSkinCorners(const Molecule& molecule);
    void chooseShaders(const Lighting& lighting);
    bool grows() const { return grow_ > 0 || shrink_ > 0; }
    void setShape(const gpu::Program& program, float pixelsPerMeter) const;

    Material material_;
    InstanceColors colors_;
    bool points_;
    int skinWeights_ = 0;           // 0: the molecule's own triangles are drawn
    bool skinOffsets_ = false;      // some vertex of the skin lies off them
    double grow_ = 0, shrink_ = 0;  // s (scene/emitter.h)
    gpu::Buffer uvs_, indices_;     // none: points
    gpu::Buffer skin_;              // on which vertices its own depend (shaders/render/skinned.vert)
    gpu::Texture image_;            // none: plain colour
};

// A group of point particles by their type (scene/particle.h): dots, sprites or quads, whose looks the vertex
// stage works out from age and seed (shaders/particles). What the type does not use is not in the shaders.
//
// An instance of a draw is a batch of particles that share one stream of corners: an instance each would
// leave most lanes of a GPU, or of a CPU's vectors, idle.
//
// Particles that are not blended cast shadows; blended ones do not.
class ParticleDrawer : public GroupDrawer {
  public:
    // `pixelsPerMeter`: about where the camera looks. Error: loadImage's.
    ParticleDrawer(gpu::Context& context, gpu::Programs& programs, const ParticleType& type,
                   const GroupPlan& plan, size_t index, const Lighting& lighting, double pixelsPerMeter);

    // Other looks, from the next picture on. False, and nothing changes: they need another image, order or
    // stream of corners.
    bool change(const ParticleType& type, const Lighting& lighting);

    bool readsDepth() const override { return type_.softness > 0 && type_.blend != Blend::none; }
    const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) override;
    const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) override;

  private:
    void makeStream();
    void chooseShaders(const Lighting& lighting);
    std::vector<std::string> defines() const;
    void setType(const gpu::Program& program) const;
    void setView(const gpu::Program& program, const glm::mat3& viewToScene, const glm::vec4& eyeAt,
                 const glm::vec2& pictureSize, float pixelsPerMeter, double time) const;
    void setColors(const gpu::Program& program) const;

    ParticleType type_;
    double pixelsPerMeter_;
    bool ages_;  // some are born or die
    gpu::Buffer indices_;
    gpu::Texture image_;  // none: a dot
};

// ---- The images that they are drawn with (group_image.cpp)
//
// They are mipmapped, rows bottom first. Colour is spread from inside the shape over what is cut away, so
// that smaller mip levels do not mix the background's colour into the rim.

// Error: no such file, or not a PNG.
gpu::Texture loadImage(gpu::Context& context, const Molecule& molecule);

// The tiles in use as layers, from the first, mipmapped each by itself: none bleeds into its neighbour at any
// distance. Error: no such file, not a PNG, tiles that do not fill it, or more of them than the context has
// layers.
gpu::Texture loadImage(gpu::Context& context, const ParticleImage& image);

}  // namespace shoal
