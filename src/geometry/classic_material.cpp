#include "geometry/classic_material.h"

#include <algorithm>
#include <cmath>

namespace shoal {

double roughnessOfExponent(double exponent) {
    return std::clamp(std::pow(2 / (exponent + 2), 0.25), 0.2, 1.0);
}

void setOpacity(SurfaceMaterial& material, double opacity, int mask, ModelImages& reader,
                const std::vector<Image>& images, const std::function<void(const std::string&)>& note) {
    if (opacity <= 0) {
        note("it is wholly transparent in the file, and drawn opaque");
    } else if (opacity < 1) {
        material.alpha = SurfaceMaterial::Alpha::blend;
        material.color.a = opacity;
    }
    if (mask >= 0) material.colorImage = reader.masked(material.colorImage, mask);
    if (material.alpha == SurfaceMaterial::Alpha::opaque && material.colorImage >= 0 &&
        anyTransparent(images[size_t(material.colorImage)]))
        material.alpha = SurfaceMaterial::Alpha::cut;
}

void setRefraction(SurfaceMaterial& material, double index) {
    constexpr double densest = 3;  // diamond has 2.4
    if (material.alpha == SurfaceMaterial::Alpha::blend && index > 1 && index <= densest)
        material.refraction = index;
}

}  // namespace shoal
