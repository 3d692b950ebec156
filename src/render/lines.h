// Lines over the molecules: springs, coloured by their strain, and lines that are computed on the CPU, such
// as arrows of a field.
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

struct Line {
    glm::dvec3 from{0}, to{0};  // m
    glm::vec3 color{1};         // linear RGB
};

class LineDrawer {
  public:
    explicit LineDrawer(gpu::Context& context);

    // `width`: pixels. 144 bytes a line cross the bus, as parameters.
    void draw(const std::vector<Line>& lines, double width, const DrawInputs& inputs);

  private:
    void hold(size_t lines);

    gpu::Context* context_;
    gpu::Program program_;  // made when first drawn
    gpu::Buffer corners_;
    gpu::VertexArray array_;
    size_t room_ = 0;  // lines that corners_ holds
};

// Springs, blue where they are pushed together, red where they are pulled apart. Drawn straight from the
// state of any path, a molecule an instance; nothing crosses the bus.
class SpringLines {
  public:
    // Borrows nothing. `plan` of the scene.
    SpringLines(gpu::Context& context, const Scene& scene, const Plan& plan);

    // Draws those of all molecules. `strainShown`: at which a colour is full, above 0; `width`: pixels.
    void draw(const StateView& state, const DrawInputs& inputs, double strainShown, double width);
    // Draws those of one molecule. `group`: of the plan.
    void drawOne(const StateView& state, const DrawInputs& inputs, double strainShown, double width,
                 size_t group, int molecule);

  private:
    struct Drawn {
        StateReader reader;
        int count = 0;    // molecules
        int corners = 0;  // six a spring: two triangles
        bool scaled = false;
        std::string name;
        gpu::Buffer ends;
        gpu::VertexArray array;
        std::array<gpu::Program, StateView::forms> programs;  // made when first drawn
    };
    void draw(Drawn& group, const StateView& state, const DrawInputs& inputs, double strainShown,
              double width, std::optional<int> only);
    const gpu::Program& program(Drawn& group, const StateView& state, const DrawInputs& inputs);

    gpu::Context* context_;
    std::vector<Drawn> groups_;
};

}  // namespace shoal
