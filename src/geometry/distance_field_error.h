// A field against exact distances.
#pragma once

#include "geometry/closest_point.h"
#include "geometry/distance_field.h"

namespace shoal {

// In the middles of at most 20,000 cells, evenly chosen among those within a cell of the surface, or of where
// vertices of that thickness rest. What is inside and nearest to a hidden wall has no exact distance here and
// is left out.
FieldError measureError(const DistanceField& field, const Mesh& mesh, const ClosestPoints& closest,
                        double thickness, int threads);

}  // namespace shoal
