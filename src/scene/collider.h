// Describes the solids that molecules collide with, standing still or moving, and how surfaces answer one
// another. SI units; every default is the file's.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "geometry/distance_field.h"
#include "scene/collider_path.h"

namespace shoal {

class Description;

struct PlaneCollider {
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};  // free side
};

struct SphereCollider {
    glm::dvec3 center{0};
    double radius = 1;  // m
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
};

struct BoxCollider {
    glm::dvec3 center{0};
    glm::dvec3 size{1};  // m, whole edges
    glm::dquat rotation{1, 0, 0, 0};
};

// All within `radius` of the line between two points; a sphere where they coincide.
struct CapsuleCollider {
    glm::dvec3 from{0}, to{0};
    double radius = 1;  // m
};

// The surface of a model, by signed distances on a grid around it.
struct DistanceFieldCollider {
    std::string model;  // its name
    FieldRequest request;
    DistanceField field;
};

using ColliderShape = std::variant<PlaneCollider, SphereCollider, HeightFieldCollider, BoxCollider,
                                   CapsuleCollider, DistanceFieldCollider>;

struct Collider {
    std::string name;
    std::string surface = {};  // what it is made of, for surfacePairs; empty: nothing in particular
    ColliderShape shape;
    double restitution = 0.2;               // in [0, 1]
    double friction = 0.5;                  // Coulomb's mu, at least 0
    double thickness = 0.002;               // m: vertices rest this far from the surface
    std::optional<ColliderPath> path = {};  // nothing: it stands still
    bool draw = true;                       // all but height and distance fields, which show as their model
    glm::dvec3 color{0.2, 0.21, 0.19};
};

// Restitution and friction between two surfaces, by the names that colliders and groups give them. What is
// left out is as without the rule (compile/surface_pair.h).
struct SurfaceRule {
    std::string a, b;  // in any order; may be the same
    std::optional<double> restitution, friction;
};

const Description& describe(const PlaneCollider*);
const Description& describe(const SphereCollider*);
const Description& describe(
    const HeightFieldCollider*);  // scene/json/colliders.cpp: its heights are in a file
const Description& describe(const BoxCollider*);
const Description& describe(const CapsuleCollider*);
const Description& describe(const DistanceFieldCollider*);  // likewise: it is made from a model
const Description& describe(const Collider*);
const Description& describe(const SurfaceRule*);

const char* kindName(const ColliderShape& shape);  // its word in files

}  // namespace shoal
