// Describes the solids that molecules collide with, standing still or moving, and how surfaces answer one
// another. The kinds: scene/collider_kinds.h. SI units; every default is the file's.
#pragma once

#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "core/boxed.h"
#include "scene/collider_path.h"

namespace shoal {

class Description;

struct ColliderShape;  // one of the kinds
extern template class Boxed<ColliderShape>;

struct Collider {
    std::string name;
    std::string surface = {};  // what it is made of, for surfacePairs; empty: nothing in particular
    Boxed<ColliderShape> shape;
    double restitution = 0.2;  // in [0, 1]
    double friction = 0.5;     // Coulomb's mu, at least 0
    double thickness = 0.002;  // m: vertices rest this far from the surface, or the radius of contact
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

const Description& describe(const Collider*);
const Description& describe(const SurfaceRule*);

const char* kindName(const ColliderShape& shape);  // its word in files

}  // namespace shoal
