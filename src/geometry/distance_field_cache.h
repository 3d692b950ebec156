// Baked fields on disk, so that a model is baked once. By content: of the mesh, the request and the version
// of the baking, so that nothing is ever out of date.
//
// One file a field, <folder>/<key>.shoal-field; numbers as this machine has them in memory: a head (see the
// source), then the distances as floats.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "geometry/distance_field.h"

namespace shoal {

constexpr size_t keptFields = 32;  // beyond that the oldest are removed

// Where fields are kept (empty: nowhere) and who hears of the baking.
struct FieldBaking {
    std::string cache;
    FieldProgress progress;
};

// From the cache, else baked and kept. A damaged or foreign file is baked anew, with a warning; so is one
// that cannot be written. Error: as bakeDistanceField.
DistanceField distanceFieldOf(const Mesh& mesh, const FieldRequest& request, const FieldBaking& baking,
                              std::vector<Warning>& warnings);

}  // namespace shoal
