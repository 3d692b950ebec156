// Draws every group of molecules straight from the state textures, one instanced draw each: gl_InstanceID is
// the molecule, gl_VertexID its vertex. The state is read and nothing of it crosses the bus.
#pragma once

#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/lighting.h"
#include "render/view.h"
#include "simulate/state.h"

namespace shoal {

class MoleculeDrawer {
  public:
    MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene, const Plan& plan,
                   const Lighting& lighting, const ShadowMap* shadow);

    void drawShadows(const State& state, const ShadowMap& shadow) const;
    // With several samples a pixel, edges of cut-out shapes are spread over them (alpha to coverage).
    void draw(const State& state, const Eye& eye, const Lighting& lighting, bool multisampled) const;

  private:
    struct Drawn {
        size_t index = 0;  // of the group in the plan
        int count = 0, vertexCount = 0, indexCount = 0;
        glm::ivec4 rows{0};
        glm::vec3 color{0}, secondColor{0};
        float alphaCut = 0.5f, roughness = 0.7f, translucency = 0, pointSize = 0.02f;  // m
        gpu::Program lit, depth;
        gpu::Buffer uvs, indices;  // none: points
        gpu::VertexArray corners;
        gpu::Texture image;  // none: plain colour
    };

    Drawn make(const std::string& shaderRoot, const Group& group, const GroupPlan& plan,
               const Lighting& lighting, bool casts) const;
    void bindState(const gpu::Program& program, const Drawn& group, const State& state) const;
    void submit(const Drawn& group) const;

    gpu::Context* context_;
    std::vector<Drawn> groups_;
};

}  // namespace shoal
