#include "geometry/model_images.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;

// Half as wide and high; each texel is the mean of four.
Image halved(const Image& image) {
    Image out{std::max(image.width / 2, 1), std::max(image.height / 2, 1), 4, {}};
    out.pixels.resize(size_t(out.width) * size_t(out.height) * 4);
    uint8_t* to = out.pixels.data();
    const auto row = [&](int y) {
        return image.pixels.data() + size_t(std::min(y, image.height - 1)) * size_t(image.width) * 4;
    };
    const size_t right = image.width > 1 ? 4 : 0;
    for (int y = 0; y < out.height; ++y) {
        const uint8_t *above = row(2 * y), *below = row(2 * y + 1);
        for (int x = 0; x < out.width; ++x, above += 8, below += 8, to += 4)
            for (size_t c = 0; c < 4; ++c)
                to[c] = uint8_t((above[c] + above[right + c] + below[c] + below[right + c] + 2) / 4);
    }
    return out;
}

std::string lowered(const fs::path& name) {
    std::string text = name.string();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

}  // namespace

ModelImages::ModelImages(const ModelFile& model, std::vector<Image>& images)
    : folder_(fs::path(model.name).parent_path()), opened_(model.opened), images_(images) {}

int ModelImages::fromFile(const std::string& path, const Told& told) {
    return kept(
        path,
        [&] {
            const fs::path file = find(path);
            const std::string bytes = readFile(file);
            opened_(bytes.size());
            return decoded(bytes, file.string());
        },
        told);
}

int ModelImages::kept(const std::string& key, const std::function<Image()>& make, const Told& told) {
    const auto [known, fresh] = numbers_.try_emplace(key, -1);
    if (!fresh) return known->second;
    try {
        Image image = make();
        while (std::max(image.width, image.height) > largestModelImage)
            image = halved(image);
        images_.push_back(std::move(image));
        known->second = int(images_.size()) - 1;
    } catch (const Error& error) {
        told(error.what());
    }
    return known->second;
}

// An image may be packed into much fewer bytes than reading it takes: it is worth as much as a file that
// holds a tenth of its texels' bytes.
Image ModelImages::decoded(const std::string& bytes, const std::string& name) const {
    opened_(std::min(texelsOf(bytes), maxImageTexels) * 4 / 10);
    return decodeImage(bytes, name);
}

int ModelImages::masked(int colorImage, int mask) {
    if (colorImage == mask) return colorImage;
    Image out = images_[size_t(mask)];
    const bool hasAlpha = anyTransparent(out);
    const Image* colors = colorImage >= 0 ? &images_[size_t(colorImage)] : nullptr;
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            uint8_t* texel = &out.pixels[(size_t(y) * size_t(out.width) + size_t(x)) * 4];
            if (!hasAlpha) texel[3] = std::max({texel[0], texel[1], texel[2]});
            const uint8_t white[3] = {255, 255, 255};
            const uint8_t* from = white;
            if (colors) {
                const size_t u = size_t(x) * size_t(colors->width) / size_t(out.width);
                const size_t v = size_t(y) * size_t(colors->height) / size_t(out.height);
                from = &colors->pixels[(v * size_t(colors->width) + u) * 4];
            }
            std::copy_n(from, 3, texel);
        }
    images_.push_back(std::move(out));
    return int(images_.size()) - 1;
}

int ModelImages::roughAndMetallic(int roughness, int metallic) {
    if (roughness == metallic) return roughness;  // whose channels are made so
    Image out = images_[size_t(metallic >= 0 ? metallic : roughness)];
    const auto green = [&](int number, size_t x, size_t y) -> uint8_t {
        if (number < 0) return 255;
        const Image& from = images_[size_t(number)];
        const size_t u = x * size_t(from.width) / size_t(out.width);
        const size_t v = y * size_t(from.height) / size_t(out.height);
        return from.pixels[(v * size_t(from.width) + u) * 4 + 1];
    };
    for (size_t y = 0; y < size_t(out.height); ++y)
        for (size_t x = 0; x < size_t(out.width); ++x) {
            uint8_t* texel = &out.pixels[(y * size_t(out.width) + x) * 4];
            texel[1] = green(roughness, x, y);
            texel[2] = green(metallic, x, y);
        }
    images_.push_back(std::move(out));
    return int(images_.size()) - 1;
}

// Paths are of the machine on which the model was made, whose names may not tell "A" from "a".
fs::path ModelImages::find(std::string path) const {
    std::replace(path.begin(), path.end(), '\\', '/');
    const fs::path written(path), name = written.filename();
    std::error_code code;
    const auto readable = [&](const fs::path& file) {
        return mayOpen(file) && fs::is_regular_file(file, code);
    };
    if (readable(folder_ / written)) return folder_ / written;
    for (const fs::path& folder : {folder_, folder_ / "textures", folder_.parent_path() / "textures"}) {
        if (readable(folder / name)) return folder / name;
        const fs::path beside = folder.empty() ? "." : folder;
        for (fs::directory_iterator entry(beside, code), end; !code && entry != end; entry.increment(code))
            if (lowered(entry->path().filename()) == lowered(name) && readable(entry->path()))
                return entry->path();
    }
    throw Error("there is no ", name.empty() ? fs::path("file") : name, " beside the model");
}

bool anyTransparent(const Image& image) {
    for (size_t i = 3; i < image.pixels.size(); i += 4)
        if (image.pixels[i] < 250) return true;
    return false;
}

}  // namespace shoal
