// The texels of textures whose layers hold one number of an element each, in memory and back.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/context.h"
#include "gpu/texture.h"

namespace shoal {

// Texels by number, of each layer after the other.
template <typename T>
std::vector<T> readLayers(const gpu::Texture& texture, gpu::Traffic::Kind kind = gpu::Traffic::Kind::state) {
    const size_t texels = size_t(texture.width()) * size_t(texture.height());
    const int layers = std::max(texture.layers(), 1);
    std::vector<T> out(texels * size_t(layers));
    for (int layer = 0; layer < layers; ++layer)
        texture.download(kind, 0, 0, texture.width(), texture.height(), out.data() + texels * size_t(layer),
                         texels * sizeof(T), layer);
    return out;
}

template <typename T>
void writeLayers(gpu::Texture& texture, std::vector<T> values) {
    const size_t texels = size_t(texture.width()) * size_t(texture.height());
    const int layers = std::max(texture.layers(), 1);
    values.resize(texels * size_t(layers));
    for (int layer = 0; layer < layers; ++layer)
        texture.upload(gpu::Traffic::Kind::state, 0, 0, texture.width(), texture.height(),
                       values.data() + texels * size_t(layer), texels * sizeof(T), layer);
}

// Layers become the values of one element after another, and back.
std::vector<glm::vec4> byElement(const std::vector<glm::vec4>& layered, size_t stride, size_t count);
std::vector<glm::vec4> byLayer(const std::vector<glm::vec4>& values, size_t stride, size_t count);

}  // namespace shoal
