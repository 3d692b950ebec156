#include "render/particle_image.h"

#include <algorithm>

#include "core/error.h"
#include "core/image.h"
#include "render/leaf_image.h"

namespace shoal {

static Image tileOf(const Image& image, int x, int y, int width, int height) {
    Image out{width, height, 4, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    const auto row = std::ptrdiff_t(width) * 4;
    for (int i = 0; i < height; ++i)
        std::copy_n(image.pixels.begin() + (std::ptrdiff_t(y + i) * image.width + x) * 4, row,
                    out.pixels.begin() + i * row);
    return out;
}

gpu::Texture loadParticleImage(gpu::Context& context, const ParticleImage& image) {
    const Image whole = readPng(image.file);
    if (whole.width % image.columns != 0 || whole.height % image.rows != 0)
        throw Error(concat(image.file, ": ", image.columns, " x ", image.rows,
                           " tiles of the same size do not fill ", whole.width, " x ", whole.height,
                           " pixels"));
    const int width = whole.width / image.columns, height = whole.height / image.rows;
    const int layers = image.lastTile - image.firstTile + 1;
    if (layers > context.info().maxTextureLayers)
        throw Error(concat(image.file, ": ", layers, " tiles are in use, and this context allows ",
                           context.info().maxTextureLayers));
    gpu::Texture texture(context, gpu::Format::srgb8a8, width, height, image.file.c_str(), layers);
    for (int layer = 0; layer < layers; ++layer) {
        const int tile = image.firstTile + layer;
        const Image pixels = bledImage(
            tileOf(whole, tile % image.columns * width, tile / image.columns * height, width, height), 1);
        texture.upload(gpu::Traffic::Kind::parameters, 0, 0, width, height, pixels.pixels.data(),
                       pixels.pixels.size(), layer);
    }
    texture.setLinear(true);
    return texture;
}

}  // namespace shoal
