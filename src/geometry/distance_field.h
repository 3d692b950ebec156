// Signed distances to a model on a grid: baked from its triangles and measured against exact distances
// (distance_field.cpp), kept on disk (distance_field_cache.cpp), read by colliders.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "geometry/mesh.h"
#include "geometry/sample_grid.h"

namespace shoal {

// Asks for a field. `resolution` and `error` exclude each other; with neither, defaultResolution holds.
struct FieldRequest {
    std::optional<int> resolution;  // cells along the model's longest side
    std::optional<double> error;    // m: refined until no probe near the surface is off by more
    std::optional<double> shell;    // m: thickness of a model that is not closed; nothing: two cells
    double thickness = 0;           // m: how far off it vertices rest, so that the grid reaches as far
};

constexpr int defaultResolution = 96, leastResolution = 4, mostResolution = 2048;
// The table on the device has rows of 1024 and as many as textures are high: 16 bytes a sample, 256 MiB.
constexpr size_t mostSamples = size_t{1} << 24;

// Measured against exact distances in the middles of cells, where a trilinear interpolant is furthest from
// its samples, no further from where vertices rest than a cell.
struct FieldError {
    size_t probes = 0;
    double most = 0, rms = 0;  // m
    glm::dvec3 where{0};       // of the largest
};

struct DistanceField {
    SampleGrid grid;
    std::vector<float> distances;  // m, negative inside, one a sample
    double outside = 0;  // m: the least on the grid's faces; beyond it further by the way to the box
    double shell = 0;    // m: thickness given to what is not closed; 0: signed

    // Parts thinner than two cells would fall between the samples: they are thickened to that.
    double thinArea = 0;      // share of the surface, in [0, 1]
    double thinnest = 0;      // m
    glm::dvec3 thinWhere{0};  // there

    FieldError error;
    SurfaceReport surface;
    int resolution = 0;   // cells along the model's longest side
    double seconds = 0;   // of baking
    bool cached = false;  // read, not baked

    size_t bytesOnDevice() const { return grid.count() * 16; }
};

// 0 .. 1 of the whole; called from the thread that bakes, not often.
using FieldProgress = std::function<void(double)>;

// Error (without a location): no surface, too large for memory (says which resolution fits), an error bound
// that what fits cannot keep.
DistanceField bakeDistanceField(const Mesh& mesh, const FieldRequest& request,
                                const FieldProgress& progress = {}, int threads = 0);

// Holds the field's value at a point: trilinear between samples inside the grid, a lower bound beyond it; and
// its gradient (1 where the field is a distance), never 0. distanceSurface of shaders/step/surfaces.glsl has
// the same definition.
struct FieldValue {
    double distance;
    glm::dvec3 gradient;
};
FieldValue valueAt(const DistanceField& field, const glm::dvec3& x);

// The finest resolution of a grid around this mesh within mostSamples; 0: none.
int finestResolution(const Mesh& mesh, const FieldRequest& request, bool closed);

// Warns of a model that is not closed, and why; of a shell too thin or needless; of thickened parts.
std::vector<std::string> fieldWarnings(const DistanceField& field, const FieldRequest& request);

// Baked fields are kept on disk, so that a model is baked once. They go by the content of the mesh, wherever
// it stands, the request and the version of the baking, so that nothing is ever out of date.
//
// One file a field, <folder>/<key>.shoal-field; numbers as this machine has them in memory: a head (see the
// source), then the distances as floats.

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
