// Pictures of any format that stb_image reads.
#include <algorithm>
#include <memory>

#include <stb_image.h>

#include "core/error.h"
#include "core/image.h"

namespace shoal {

namespace {

struct Head {
    const stbi_uc* data;
    int bytes = 0, width = 0, height = 0;  // 0 texels: no picture that is read

    explicit Head(const std::string& all) : data(reinterpret_cast<const stbi_uc*>(all.data())) {
        if (all.size() > size_t(INT32_MAX)) return;
        bytes = int(all.size());
        int channels = 0;
        if (stbi_info_from_memory(data, bytes, &width, &height, &channels) == 0) width = height = 0;
    }
    size_t texels() const { return size_t(std::max(width, 0)) * size_t(std::max(height, 0)); }
};

}  // namespace

size_t texelsOf(const std::string& bytes) {
    return Head(bytes).texels();
}

Image decodeImage(const std::string& bytes, const std::string& file) {
    const Location location{file};
    const Head head(bytes);
    if (head.texels() == 0)
        throw Error(location, "is no picture that can be read, such as PNG, JPEG, TGA or BMP");
    if (head.width > maxImageSide || head.height > maxImageSide || head.texels() > maxImageTexels)
        throw Error(location, "is ", head.width, " x ", head.height, " texels, more than the ", maxImageSide,
                    " a side or ", maxImageTexels, " in all that are read");
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(head.data, head.bytes, &width, &height, &channels, STBI_rgb_alpha),
        stbi_image_free);
    if (!pixels) throw Error(location, "is a damaged picture: ", stbi_failure_reason());
    const size_t count = size_t(width) * size_t(height) * 4;
    return {width, height, 4, std::vector<uint8_t>(pixels.get(), pixels.get() + count)};
}

}  // namespace shoal
