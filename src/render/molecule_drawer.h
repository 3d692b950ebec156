// Draws a group of molecules: gl_InstanceID is the molecule, gl_VertexID its vertex. Their triangles,
// two-sided and cut out of an image by its alpha, or those of its skin; without triangles each vertex as a
// round sprite.
#pragma once

#include "render/group_drawer.h"

namespace shoal {

class MoleculeDrawer : public GroupDrawer {
  public:
    // `plan` at `index` of the plan. Error: the image of the material is missing or not a PNG.
    MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, gpu::Programs& programs,
                   const Group& group, const GroupPlan& plan, size_t index, const Lighting& lighting);

    const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) override;
    const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) override;

    // Other colours, roughness, translucency and opacity; the rest of the group is as before.
    void change(const Group& group);

  private:
    void makeCorners(const Molecule& molecule);
    void makeSkinCorners(const Molecule& molecule);
    void chooseShaders(const Lighting& lighting);
    bool grows() const { return grow_ > 0 || shrink_ > 0; }
    void setShape(const gpu::Program& program) const;

    Material material_;
    glm::vec3 color_{0}, secondColor_{0};
    bool points_;
    std::vector<std::string> skinDefines_;  // none: the molecule's own triangles are drawn
    double grow_ = 0, shrink_ = 0;          // s (scene/emitter.h)
    gpu::Buffer uvs_, indices_;             // none: points
    gpu::Buffer skin_;                      // on which vertices its own depend (shaders/render/skinned.vert)
    gpu::Texture image_;                    // none: plain colour
};

}  // namespace shoal
