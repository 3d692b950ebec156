// A slice through a distance field as a picture.
#pragma once

#include "core/image.h"
#include "geometry/distance_field.h"

namespace shoal::app {

struct SlicePlane {
    int axis = 2;         // across: 0 x, 1 y, 2 z
    double position = 0;  // m
};

struct SlicePicture {
    Image image;
    double contours = 0;  // m, between two lines
};

// At most width x height pixels. Outside in ochre, inside in blue, deeper with the distance; a contour every
// `contours` m, the zero line black, and in white where the plane cuts the model itself. Below, a scale in m.
// y goes up, else z down.
SlicePicture drawSlice(const DistanceField& field, const Mesh& mesh, const SlicePlane& plane, int width,
                       int height);

}  // namespace shoal::app
