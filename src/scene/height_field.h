// Height fields for colliders: from a mesh seen from above, or from the grey levels of an image.
#pragma once

#include <string>

#include "core/image.h"
#include "geometry/mesh.h"
#include "scene/collider_kinds.h"

namespace shoal {

// The highest surface of the mesh at each of columns x rows samples over its bounding box in x and z.
// Samples with nothing beneath take the lowest height; their number goes to `missed` if given.
HeightFieldCollider heightFieldFromMesh(const Mesh& mesh, int columns, int rows, int* missed = nullptr);

// One sample per pixel: black is heights.x, white heights.y. The left column is low.x; the image's top
// row is low.y (the smallest z), as a map lies with north up and -Z north.
HeightFieldCollider heightFieldFromImage(const HeightImage& image, glm::dvec2 low, glm::dvec2 high,
                                         glm::dvec2 heights);

}  // namespace shoal
