// Pictures of any format that stb_image reads.
#include <algorithm>
#include <memory>

#include <stb_image.h>

#include "core/error.h"
#include "core/image.h"

namespace shoal {

size_t texelsOf(const std::string& bytes) {
    int width = 0, height = 0, channels = 0;
    if (bytes.size() > size_t(INT32_MAX) ||
        stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), int(bytes.size()), &width,
                              &height, &channels) == 0)
        return 0;
    return size_t(std::max(width, 0)) * size_t(std::max(height, 0));
}

Image decodeImage(const std::string& bytes, const std::string& file) {
    const Location location{file};
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (bytes.size() > size_t(INT32_MAX)) throw Error(location, "is larger than 2 GiB");
    const int size = int(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0)
        throw Error(location, "is no picture that can be read, such as PNG, JPEG, TGA or BMP");
    if (width < 1 || height < 1 || width > maxImageSide || height > maxImageSide ||
        size_t(width) * size_t(height) > maxImageTexels)
        throw Error(location, "is ", width, " x ", height, " texels, more than the ", maxImageSide,
                    " a side or ", maxImageTexels, " in all that are read");
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, STBI_rgb_alpha), stbi_image_free);
    if (!pixels) throw Error(location, "is a damaged picture: ", stbi_failure_reason());
    const size_t count = size_t(width) * size_t(height) * 4;
    return {width, height, 4, std::vector<uint8_t>(pixels.get(), pixels.get() + count)};
}

}  // namespace shoal
