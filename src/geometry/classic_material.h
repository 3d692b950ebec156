// Turns what the materials of older formats (OBJ, FBX, COLLADA, …) say otherwise into a SurfaceMaterial. Only
// the readers of models use it.
#pragma once

#include <functional>
#include <string>

#include "geometry/model_images.h"

namespace shoal {

// Returns the roughness of Blinn and Phong's exponent n, whose lobe is as wide as roughness^4 = 2 / (n + 2)
// [Karis 2013].
double roughnessOfExponent(double exponent);

// Sets how what is not opaque is drawn: by an opacity in [0, 1], an image of opacity (`mask`, -1: none), and
// holes in the colour image, which must be set before. `images`: those of the model.
void setOpacity(SurfaceMaterial& material, double opacity, int mask, ModelImages& reader,
                const std::vector<Image>& images, const std::function<void(const std::string&)>& note);

// Sets the index of refraction of what is blended; an index that nothing has is left out.
void setRefraction(SurfaceMaterial& material, double index);

// Lists the kinds of images that are not drawn; empty: none.
struct DroppedImages {
    std::string kinds;

    void add(const std::string& kind) { kinds += (kinds.empty() ? "" : ", ") + kind; }
    std::string note() const { return "its images of " + kinds + " are not drawn"; }
};

}  // namespace shoal
