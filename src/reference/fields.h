// Fluid velocity of a scene's fields in double precision. Formulas and units: scene/field.h.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal::reference {

// u(x, t) in m/s: the sum of the fields whose box holds x (its faces included), each times its weight.
glm::dvec3 fluidVelocity(const std::vector<Field>& fields, const glm::dvec3& x, double time);

// One shape, without weight and box.
glm::dvec3 fieldVelocity(const FieldShape& shape, const glm::dvec3& x, double time);

// The unit direction p that a gust's noise is measured along across the wind; the third, q, is along x p.
// Both scale alike with `width`, but a lattice has axes, so that the choice belongs to the definition:
// horizontal, or across x where the wind blows nearly vertically (|along.y| at least 0.9).
glm::dvec3 gustAcross(const glm::dvec3& along);

}  // namespace shoal::reference
