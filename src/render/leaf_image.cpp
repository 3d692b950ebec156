#include "render/leaf_image.h"

#include "molecule/molecule_file.h"

#include <algorithm>
#include <filesystem>

namespace shoal {

static std::vector<size_t> neighbours(const Image& image, size_t pixel) {
    const size_t width = size_t(image.width), x = pixel % width, y = pixel / width;
    std::vector<size_t> out;
    if (x > 0) out.push_back(pixel - 1);
    if (x + 1 < width) out.push_back(pixel + 1);
    if (y > 0) out.push_back(pixel - width);
    if (y + 1 < size_t(image.height)) out.push_back(pixel + width);
    return out;
}

Image bledImage(const Image& image, int inside) {
    Image out = image;
    const size_t row = size_t(image.width) * 4;
    for (int y = 0; y < image.height; ++y) {
        std::copy_n(image.pixels.begin() + std::ptrdiff_t(size_t(y) * row), row,
                    out.pixels.begin() + std::ptrdiff_t(size_t(image.height - 1 - y) * row));
    }
    // Breadth first from everything that is inside, each pixel taking the colour that reached it.
    std::vector<bool> known(out.pixels.size() / 4);
    std::vector<size_t> front;
    for (size_t i = 0; i < known.size(); ++i) {
        known[i] = out.pixels[4 * i + 3] >= inside;
        if (known[i]) front.push_back(i);
    }
    for (size_t next = 0; next < front.size(); ++next) {
        const size_t from = front[next];
        for (const size_t to : neighbours(out, from)) {
            if (known[to]) continue;
            known[to] = true;
            std::copy_n(out.pixels.begin() + std::ptrdiff_t(4 * from), 3,
                        out.pixels.begin() + std::ptrdiff_t(4 * to));
            front.push_back(to);
        }
    }
    return out;
}

gpu::Texture loadLeafImage(gpu::Context& context, const Molecule& molecule) {
    const Image image = bledImage(readTexture(molecule));
    gpu::Texture texture(context, gpu::Format::srgb8a8, image.width, image.height,
                         molecule.material.texture.c_str());
    texture.upload(gpu::Traffic::Kind::parameters, 0, 0, image.width, image.height, image.pixels.data(),
                   image.pixels.size());
    texture.setLinear(true);
    return texture;
}

}  // namespace shoal
