// Draws every group of molecules straight from the state of either path, one instanced draw each:
// gl_InstanceID is the molecule, gl_VertexID its vertex. The state is read and nothing of it crosses the bus.
//
// Groups with a blend are drawn after everything else, from back to front (render/draw_order.h):
// gl_InstanceID is the place in the order. Several of them take turns in slabs of depth
// (render/depth_slabs.h).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/depth_slabs.h"
#include "render/draw_order.h"
#include "render/lighting.h"
#include "render/slab_draws.h"
#include "render/view.h"
#include "simulate/state_view.h"

namespace shoal {

class MoleculeDrawer {
  public:
    MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene, const Plan& plan,
                   const Lighting& lighting, int slabs);

    static bool blends(const Scene& scene, const Plan& plan);  // whether a group of the plan does
    bool blends() const { return blends_; }

    void drawShadows(const StateView& state, const ShadowMap& shadow);
    // With several samples a pixel, edges of cut-out shapes are spread over them (alpha to coverage).
    void draw(const StateView& state, const Eye& eye, const Lighting& lighting, bool multisampled);
    // Before the framebuffer of the picture is bound: the orders of what is blended.
    void order(const StateView& state, const Eye& eye);
    void drawBlended(const StateView& state, const Eye& eye, const Lighting& lighting);

    const DrawOrder* orderOf(size_t group) const;  // of the plan; null: it has none. For tests

  private:
    struct Drawn {
        size_t index = 0;  // of the group in the plan
        int count = 0, vertexCount = 0, indexCount = 0;
        glm::ivec4 rows{0};
        glm::vec3 color{0}, secondColor{0};
        float alphaCut = 0.5f, roughness = 0.7f, translucency = 0, pointSize = 0.02f;  // m
        BufferLayout layout;
        gpu::ProgramOptions litOptions, depthOptions;  // but for what the kind of the state adds
        std::array<gpu::Program, 2> lit, depth;        // for textures, for buffers; made when first drawn
        gpu::Buffer uvs, indices;                      // none: points
        gpu::VertexArray corners;
        gpu::Texture image;  // none: plain colour
        Blend blend = Blend::none;
        float opacity = 1;
        std::unique_ptr<DrawOrder> order;      // none: as they are numbered
        std::unique_ptr<SlabDraws> slabDraws;  // where there are slabs and the order is exact
    };

    Drawn make(const Group& group, const GroupPlan& plan, const Lighting& lighting) const;
    const gpu::Program& program(const Drawn& group, std::array<gpu::Program, 2>& programs,
                                const gpu::ProgramOptions& options, const StateView& state) const;
    void drawSlab(const gpu::Program& program, const Drawn& group, const StateView& state, int slab) const;
    void makeOrders(gpu::Context& context, const Scene& scene, const Plan& plan, int slabs);
    const gpu::Program& useLit(Drawn& group, const StateView& state, const Eye& eye,
                               const Lighting& lighting);
    // Binds the state and draws it: of the buffers, each part by itself.
    void submit(const gpu::Program& program, const Drawn& group, const StateView& state) const;
    void drawInstances(const Drawn& group, int count) const;

    gpu::Context* context_;
    std::string shaderRoot_;
    std::vector<Drawn> groups_;
    bool blends_ = false;
    std::unique_ptr<DepthSlabs> slabs_;  // where several groups are blended
    size_t slabsOf_ = 0;                 // whose order the slabs are cut by
};

}  // namespace shoal
