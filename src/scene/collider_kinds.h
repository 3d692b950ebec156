// The kinds of colliders' shapes. Each has its description for files, how far it reaches, the call of its
// function in shaders/physics/solid.glsl, or in shaders/step/surfaces.glsl where it reads samples, and its
// double-precision twin in reference/colliders.cpp. docs/adding-a-force.md says how to add one. SI units.
//
// `reach`: no point of it is further (m) from a point of the frame in which it is given. Nothing of what
// is solid all the way down: a vertex could cross the others within a substep, and they are looked for along
// its way.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "geometry/distance_field.h"
#include "scene/collider.h"
#include "scene/glsl_call.h"

namespace shoal {

struct HeightImage;

struct PlaneCollider {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};  // free side
    std::optional<double> reach(const glm::dvec3&) const { return {}; }
    GlslCall call() const;
};

struct SphereCollider {
    glm::dvec3 center{0};
    double radius = 1;  // m
    std::optional<double> reach(const glm::dvec3& point) const {
        return glm::distance(center, point) + radius;
    }
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
    std::vector<float> heights;   // m, x fastest
    bool sampledNormals = false;  // normal from three height samples (Latta 3.4.2) instead of stored ones
    HeightSource source = {};
    std::optional<double> reach(const glm::dvec3&) const { return {}; }
    GlslCall call() const;
};

struct BoxCollider {
    glm::dvec3 center{0};
    glm::dvec3 size{1};  // m, whole edges
    glm::dquat rotation{1, 0, 0, 0};
    std::optional<double> reach(const glm::dvec3& point) const {
        return glm::distance(center, point) + glm::length(size) / 2;
    }
    GlslCall call() const;
};

// All within `radius` of the line between two points; a sphere where they coincide.
struct CapsuleCollider {
    glm::dvec3 from{0}, to{0};
    double radius = 1;  // m
    std::optional<double> reach(const glm::dvec3& point) const {
        return std::max(glm::distance(from, point), glm::distance(to, point)) + radius;
    }
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
    GlslCall call() const;
};

struct ColliderShape : std::variant<PlaneCollider, SphereCollider, HeightFieldCollider, BoxCollider,
                                    CapsuleCollider, DistanceFieldCollider> {
    using variant::variant;
};

// Holds the highest surface of the mesh at each of columns x rows samples over its bounding box in x and z.
// Samples with nothing beneath take the lowest height; their number goes to `missed` if given.
HeightFieldCollider heightFieldFromMesh(const Mesh& mesh, int columns, int rows, int* missed = nullptr);

// Holds one sample per pixel: black is heights.x, white heights.y. The left column is low.x; the image's top
// row is low.y (the smallest z), as a map lies with north up and -Z north.
HeightFieldCollider heightFieldFromImage(const HeightImage& image, glm::dvec2 low, glm::dvec2 high,
                                         glm::dvec2 heights);

std::optional<double> reachOf(const ColliderShape& shape, const glm::dvec3& point = glm::dvec3(0));
GlslCall callOf(const ColliderShape& shape);  // its samples are the shape's

const Description& describe(const PlaneCollider*);
const Description& describe(const SphereCollider*);
const Description& describe(const HeightFieldCollider*);  // scene/json/colliders.cpp: from a file
const Description& describe(const BoxCollider*);
const Description& describe(const CapsuleCollider*);
const Description& describe(const DistanceFieldCollider*);  // likewise: it is made from a model

}  // namespace shoal
