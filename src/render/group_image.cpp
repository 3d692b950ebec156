// The images of groups, made ready for mipmaps.
#include <algorithm>

#include "core/error.h"
#include "core/image.h"
#include "molecule/molecule_file.h"
#include "render/group_drawer.h"
#include "render/picture.h"

namespace shoal {

// Calls visit(index) for the up to four pixels beside one.
template <typename Visit>
static void neighbours(const Image& image, size_t pixel, Visit&& visit) {
    const size_t width = size_t(image.width), x = pixel % width, y = pixel / width;
    if (x > 0) visit(pixel - 1);
    if (x + 1 < width) visit(pixel + 1);
    if (y > 0) visit(pixel - width);
    if (y + 1 < size_t(image.height)) visit(pixel + width);
}

// Returns the image as RGBA, rows bottom first. Colour is spread from inside the shape, where alpha is at
// least `inside`, over what is cut away.
static Image bledImage(Image out, int inside) {
    turnOver(out);
    // Breadth first from the rim of what is inside, each pixel taking the colour that reached it.
    std::vector<bool> known(out.pixels.size() / 4);
    for (size_t i = 0; i < known.size(); ++i)
        known[i] = out.pixels[4 * i + 3] >= inside;
    std::vector<uint32_t> front, next;  // pixels: at most maxImageTexels
    for (size_t i = 0; i < known.size(); ++i) {
        bool rim = false;
        neighbours(out, i, [&](size_t to) { rim = rim || !known[to]; });
        if (known[i] && rim) front.push_back(uint32_t(i));
    }
    for (; !front.empty(); front.swap(next), next.clear())
        for (const size_t from : front)
            neighbours(out, from, [&](size_t to) {
                if (known[to]) return;
                known[to] = true;
                std::copy_n(out.pixels.begin() + std::ptrdiff_t(4 * from), 3,
                            out.pixels.begin() + std::ptrdiff_t(4 * to));
                next.push_back(uint32_t(to));
            });
    return out;
}

gpu::Texture loadImage(gpu::Context& context, const Molecule& molecule) {
    const Image image = bledImage(readTexture(molecule), 128);
    gpu::Texture texture(context, gpu::Format::srgb8a8, image.width, image.height,
                         molecule.material.texture.c_str());
    texture.upload(gpu::Traffic::Kind::parameters, 0, 0, image.width, image.height, image.pixels.data(),
                   image.pixels.size());
    texture.setLinear(true);
    return texture;
}

static Image tileOf(const Image& image, int x, int y, int width, int height) {
    Image out{width, height, 4, std::vector<uint8_t>(size_t(width) * size_t(height) * 4)};
    const auto row = std::ptrdiff_t(width) * 4;
    for (int i = 0; i < height; ++i)
        std::copy_n(image.pixels.begin() + (std::ptrdiff_t(y + i) * image.width + x) * 4, row,
                    out.pixels.begin() + i * row);
    return out;
}

gpu::Texture loadImage(gpu::Context& context, const ParticleImage& image) {
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
