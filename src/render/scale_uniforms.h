// A colour scale as shaders/render/color_scale.glsl takes it.
#pragma once

#include <array>

#include "gpu/program.h"
#include "scene/color_scale.h"

namespace shoal {

struct ScaleUniforms {
    std::array<glm::vec4, mostScaleColors> colors{};
    int last = 1, vertices = 1;
    glm::vec2 span{0};

    ScaleUniforms(const ColorScale& scale, int vertexCount)
        : last(int(scale.colors.size()) - 1),
          vertices(vertexCount),
          span(float(scale.from), float(1 / (scale.to - scale.from))) {
        for (size_t i = 0; i < scale.colors.size(); ++i)
            colors[i] = glm::vec4(glm::vec3(scale.colors[i]), 1);
    }
    void apply(const gpu::Program& program) const {
        program.set("scaleColors", std::span<const glm::vec4>(colors));
        program.set("scaleLast", last);
        program.set("scaleSpan", span);
        program.set("scaleVertices", vertices);
    }
};

}  // namespace shoal
