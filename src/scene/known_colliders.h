// The kinds of colliders that other rooms name, and what can be asked of any kind. A room that knows no more
// is not built anew when a kind is added (scene/collider_kinds.h, which says what each function tells). SI
// units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/distance_field.h"
#include "scene/collider.h"
#include "scene/glsl_call.h"

namespace shoal {

struct HeightImage;

constexpr double planeOperations = 6;  // of a vertex: the distance from a plane

struct PlaneCollider {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};  // free side
    std::optional<double> reach(const glm::dvec3&) const { return {}; }
    std::optional<double> support(const glm::dvec3&) const { return {}; }
    std::optional<double> girth() const { return {}; }
    static constexpr ReadingCost cost{planeOperations};
    GlslCall call() const;
};

// Heights are read from an image, or from a model seen from above.
struct HeightSource {
    std::string image;           // a file
    glm::dvec2 low{0}, high{0};  // m: x and z of its first and last sample
    glm::dvec2 heights{0};       // m, of black and of white
    std::string model;           // its name
    int resolution = 257;        // samples along x and along z
};

// Heights over a rectangle in x and z; beyond it there is nothing.
struct HeightFieldCollider {
    int columns = 0, rows = 0;    // samples along x and z, at least 2
    glm::dvec2 low{0}, high{0};   // m: x and z of the first and last sample
    double level = 0;             // m: y of the height 0
    std::vector<float> heights;   // m, x fastest
    bool sampledNormals = false;  // normal from three height samples (Latta 3.4.2) instead of stored ones
    HeightSource source = {};
    std::optional<double> reach(const glm::dvec3&) const { return {}; }
    std::optional<double> support(const glm::dvec3&) const { return {}; }
    std::optional<double> girth() const { return {}; }
    static constexpr ReadingCost cost{40, 4};
    GlslCall call() const;
};

// The surface of a model, by signed distances on a grid around it.
struct DistanceFieldCollider {
    std::string model;  // its name
    FieldRequest request;
    DistanceField field;
    std::optional<double> reach(const glm::dvec3& point) const {
        return glm::length(glm::max(glm::abs(field.grid.low - point), glm::abs(field.grid.high() - point)));
    }
    std::optional<double> support(const glm::dvec3&) const { return {}; }
    std::optional<double> girth() const { return {}; }
    static constexpr ReadingCost cost{70, 8};
    GlslCall call() const;
};

// The shape as one of the kinds above; null: it is another.
template <typename Kind>
const Kind* kindOf(const ColliderShape& shape);
template <typename Kind>
bool isKind(const Collider& collider) {
    return kindOf<Kind>(*collider.shape) != nullptr;
}
extern template Boxed<ColliderShape>::Boxed(PlaneCollider);
extern template Boxed<ColliderShape>::Boxed(HeightFieldCollider);

size_t kindIndex(const ColliderShape& shape);
std::optional<double> reachOf(const ColliderShape& shape, const glm::dvec3& point = glm::dvec3(0));
std::optional<double> supportOf(const ColliderShape& shape, const glm::dvec3& direction);
std::optional<double> girthOf(const ColliderShape& shape);
ReadingCost costOf(const ColliderShape& shape);
GlslCall callOf(const ColliderShape& shape);  // its samples are the shape's

// Holds the highest surface of the mesh at each of columns x rows samples over its bounding box in x and z.
// Samples with nothing beneath take the lowest height; their number goes to `missed` if given.
HeightFieldCollider heightFieldFromMesh(const Mesh& mesh, int columns, int rows, int* missed = nullptr);

// Holds one sample per pixel: black is heights.x, white heights.y. The left column is low.x; the image's top
// row is low.y (the smallest z), as a map lies with north up and -Z north.
HeightFieldCollider heightFieldFromImage(const HeightImage& image, glm::dvec2 low, glm::dvec2 high,
                                         glm::dvec2 heights);

const Description& describe(const PlaneCollider*);
const Description& describe(const HeightFieldCollider*);    // scene/json/colliders.cpp: from a file
const Description& describe(const DistanceFieldCollider*);  // likewise: it is made from a model

}  // namespace shoal
