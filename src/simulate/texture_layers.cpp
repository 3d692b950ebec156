#include "simulate/texture_layers.h"

namespace shoal {

std::vector<glm::vec4> byElement(const std::vector<glm::vec4>& layered, size_t stride, size_t count) {
    std::vector<glm::vec4> out;
    for (size_t i = 0; i < count; ++i)
        for (size_t value = i; value < layered.size(); value += stride)
            out.push_back(layered[value]);
    return out;
}

std::vector<glm::vec4> byLayer(const std::vector<glm::vec4>& values, size_t stride, size_t count) {
    std::vector<glm::vec4> out(count > 0 ? values.size() / count * stride : 0);
    for (size_t i = 0; i < values.size(); ++i)
        out[i % (values.size() / count) * stride + i / (values.size() / count)] = values[i];
    return out;
}

}  // namespace shoal
