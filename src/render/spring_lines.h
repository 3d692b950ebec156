// Springs as lines, coloured by their strain: blue where they are pushed together, red where they are pulled
// apart. Drawn straight from the state of either path, a molecule an instance; nothing crosses the bus.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "render/group_drawer.h"

namespace shoal {

class SpringLines {
  public:
    // Borrows nothing. `plan` of the scene.
    SpringLines(gpu::Context& context, const std::string& shaderRoot, const Scene& scene, const Plan& plan);

    // Draws those of all molecules. `strainShown`: at which a colour is full, above 0; `width`: pixels.
    void draw(const StateView& state, const DrawInputs& inputs, double strainShown, double width);
    // Draws those of one molecule. `group`: of the plan.
    void drawOne(const StateView& state, const DrawInputs& inputs, double strainShown, double width,
                 size_t group, int molecule);

  private:
    struct Drawn {
        size_t index = 0;  // of the plan
        int count = 0;     // molecules
        int corners = 0;   // six a spring: two triangles
        bool scaled = false;
        glm::ivec4 rows{0};
        BufferLayout layout;
        std::string name;
        gpu::Buffer ends;
        gpu::VertexArray array;
        std::array<gpu::Program, 2> programs;  // for textures, for buffers; made when first drawn
    };
    void draw(Drawn& group, const StateView& state, const DrawInputs& inputs, double strainShown,
              double width, std::optional<int> only);
    const gpu::Program& program(Drawn& group, const StateView& state, const DrawInputs& inputs);

    gpu::Context* context_;
    std::string shaderRoot_;
    std::vector<Drawn> groups_;
};

}  // namespace shoal
