// Draws every group of molecules straight from the state of either path, one instanced draw each:
// gl_InstanceID is the molecule, gl_VertexID its vertex. The state is read and nothing of it crosses the bus.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/lighting.h"
#include "render/view.h"
#include "simulate/state_view.h"

namespace shoal {

class MoleculeDrawer {
  public:
    MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene, const Plan& plan,
                   const Lighting& lighting);

    void drawShadows(const StateView& state, const ShadowMap& shadow);
    // With several samples a pixel, edges of cut-out shapes are spread over them (alpha to coverage).
    void draw(const StateView& state, const Eye& eye, const Lighting& lighting, bool multisampled);

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
    };

    Drawn make(const Group& group, const GroupPlan& plan, const Lighting& lighting) const;
    const gpu::Program& program(const Drawn& group, std::array<gpu::Program, 2>& programs,
                                const gpu::ProgramOptions& options, const StateView& state) const;
    void bindTextures(const gpu::Program& program, const Drawn& group, const TextureState& state) const;
    // Binds the state and draws it: of the buffers, each part by itself.
    void submit(const gpu::Program& program, const Drawn& group, const StateView& state) const;
    void drawInstances(const Drawn& group, int count) const;

    gpu::Context* context_;
    std::string shaderRoot_;
    std::vector<Drawn> groups_;
};

}  // namespace shoal
