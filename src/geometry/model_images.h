// The images of a model: found, decoded, made small enough, each once. For the readers of models alone.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/image.h"
#include "geometry/model_reader.h"

namespace shoal {

class ModelImages {
  public:
    // Is told in words why an image is left out.
    using Told = std::function<void(const std::string& why)>;

    // Adds to `images`, which is Mesh::images.
    ModelImages(const ModelFile& model, std::vector<Image>& images);

    // Returns the number of the image at a path as the model writes it: relative to the model, else looked
    // for by its name beside the model and in `textures`; -1 where it cannot be read.
    int fromFile(const std::string& path, const Told& told);
    // The same for an image that is known by `key` and made by `make`, which throws Error.
    int kept(const std::string& key, const std::function<Image()>& make, const Told& told);
    // Decodes the bytes of an image file. `name` is for errors.
    Image decoded(const std::string& bytes, const std::string& name) const;
    // Returns the number of an image with the colours of one image (-1: white) and the alpha of `mask`, or
    // the brightness of `mask` where that has no alpha.
    int masked(int colorImage, int mask);
    // Returns the number of an image with the green of one image (-1: full) and the green of `metallic` (-1:
    // full) as its blue, as SurfaceMaterial::roughnessImage wants it; -1: there is neither.
    int roughAndMetallic(int roughness, int metallic);

  private:
    std::filesystem::path find(std::string path) const;

    std::filesystem::path folder_;
    std::function<void(uint64_t)> opened_;
    std::vector<Image>& images_;
    std::map<std::string, int> numbers_;  // by path or key
};

// Whether any texel of an RGBA image lets something through.
bool anyTransparent(const Image& image);

}  // namespace shoal
