// Describes how a scene looks under water. Only the picture depends on it.
#pragma once

#include <glm/glm.hpp>

namespace shoal {

constexpr double mostExtinction = 1000;  // 1/m

// Light that travels s metres through water keeps exp(-extinction s) of each colour, and gains
// scattering (1 - exp(-extinction s)) of its own. The sun's way down to a point counts as well as the way to
// the eye, so that what lies deep is darker and bluer.
struct Water {
    double surface = 0;                       // m: y of the calm surface; all below it is water
    glm::dvec3 extinction{0.35, 0.07, 0.05};  // 1/m, at least 0
    glm::dvec3 scattering{0.02, 0.16, 0.22};  // linear RGB: the colour of endless water
    double caustics = 0.8;                    // strength of the bright net on what the sun reaches, in [0, 1]
    double causticsSize = 1.2;                // m, of its meshes
    double causticsSpeed = 0.6;               // m/s, at which they run
    double rays = 0.5;                        // strength of beams through the water, in [0, 1]
};

class Description;
const Description& describe(const Water*);

}  // namespace shoal
