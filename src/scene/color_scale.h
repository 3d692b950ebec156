// Colours of molecules by what they do, as in Decker's figure 4: the flow seen in one picture.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// The colour at q = (quantity - from) / (to - from), clamped to [0, 1]: linear between evenly spaced colours.
struct ColorScale {
    enum class Quantity {
        speed,  // m/s, of the molecule's mean velocity
    };
    Quantity quantity = Quantity::speed;
    double from = 0, to = 1;         // of the quantity; to above from
    std::vector<glm::dvec3> colors;  // linear RGB in [0, 1], 2 to 8
};

}  // namespace shoal
