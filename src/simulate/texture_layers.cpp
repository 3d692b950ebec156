#include "simulate/texture_layers.h"

namespace shoal {

std::vector<glm::vec4> byElement(const std::vector<glm::vec4>& layered, size_t stride, size_t count) {
    std::vector<glm::vec4> out;
    for (size_t i = 0; i < count; ++i)
        for (size_t at = i; at < layered.size(); at += stride)
            out.push_back(layered[at]);
    return out;
}

std::vector<glm::vec4> byLayer(const std::vector<glm::vec4>& of, size_t stride, size_t count) {
    std::vector<glm::vec4> out(count > 0 ? of.size() / count * stride : 0);
    for (size_t i = 0; i < of.size(); ++i)
        out[i % (of.size() / count) * stride + i / (of.size() / count)] = of[i];
    return out;
}

}  // namespace shoal
