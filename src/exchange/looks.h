// How a molecule or a particle looks at a moment, worked out by the functions of the shaders that draw it
// (shaders/render/looks.glsl, shaders/particles/attributes.glsl).
#pragma once

#include <optional>
#include <span>

#include "scene/scene.h"

namespace shoal::exchange {

// A molecule at a moment. Borrows.
struct MoleculeState {
    std::span<const glm::dvec3> positions, velocities;  // m, m/s, of its simulated vertices
    uint32_t seed = 0;
    std::optional<glm::vec2> life = {};  // x age, y length of life, s; nothing: it lives for ever
};

struct Looks {
    glm::vec3 color{1};  // linear RGB in [0, 1]: what glows keeps its hue, as other programs take no more
    float opacity = 1;   // of a particle; a molecule's is in its material
    float size = 0;      // m, the diameter of a point; 0: dots of so many pixels
};

Looks looksOf(const Group& group, const MoleculeState& molecule);

// Whether these change while a molecule lives.
bool looksChange(const Group& group);

// The share of its size that the molecule has grown to.
float grownTo(const Group& group, const MoleculeState& molecule);

}  // namespace shoal::exchange
