// Colours of molecules by what they do, as in Decker's figure 4: the flow seen in one picture.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace shoal {

class Description;

constexpr size_t leastScaleColors = 2, mostScaleColors = 8;

// The colour at q = (quantity - from) / (to - from), clamped to [0, 1]: linear between evenly spaced colours.
// It stands in place of a molecule's colours, and multiplies those of a particle and of an image.
struct ColorScale {
    enum class Quantity {
        speed,  // m/s, of the molecule's mean velocity
    };
    Quantity quantity = Quantity::speed;
    double from = 0, to = 1;  // of the quantity; to above from
    // Linear RGB in [0, 1], 2 to 8. These have even steps of lightness in OKLab [Ottosson 2020], from 0.32 to
    // 0.92, and turn from blue over green to yellow: what is faster is lighter, also in a grey print.
    std::vector<glm::dvec3> colors = {{0.03, 0.012, 0.186},  {0.005, 0.057, 0.304}, {0.001, 0.141, 0.289},
                                      {0.001, 0.25, 0.322},  {0.002, 0.4, 0.334},   {0.057, 0.584, 0.268},
                                      {0.346, 0.728, 0.197}, {0.827, 0.847, 0.171}};
};

const Description& describe(const ColorScale*);

}  // namespace shoal
