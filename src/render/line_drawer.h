// Lines that are computed on the CPU, such as arrows of a field.
#pragma once

#include <string>
#include <vector>

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
    LineDrawer(gpu::Context& context, std::string shaderRoot);

    // `width`: pixels. 144 bytes a line cross the bus, as parameters.
    void draw(const std::vector<Line>& lines, double width, const DrawInputs& inputs);

  private:
    void hold(size_t lines);

    gpu::Context* context_;
    std::string shaderRoot_;
    gpu::Program program_;  // made when first drawn
    gpu::Buffer corners_;
    gpu::VertexArray array_;
    size_t room_ = 0;  // lines that corners_ holds
};

}  // namespace shoal
