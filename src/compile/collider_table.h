// Colliders that uniforms have no room for: spheres, boxes and capsules that stand still, as loops over the
// shared table of samples, so that their number is not in the text's length. Texels of a collider:
//
//   sphere    center, radius | thickness, -, number, material
//   box       center, thickness | half its size, - | quaternion | -, -, number, material
//   capsule   from, radius | axis, 1 / axis^2 | aside, thickness | -, -, number, material
//
// material: index of the uniform whose x is the restitution and y the friction. Where one float is not enough
// for some of their places, all are relative to a point of the anchors' lattice amid them.
#pragma once

#include <string>
#include <vector>

#include "compile/collider_kinds.h"

namespace shoal {

class ColliderTable {
  public:
    // Chooses the table's origin from those of the colliders that it can hold; add() fills it.
    explicit ColliderTable(const std::vector<Collider>& colliders);
    // Whether a collider can lie in the table.
    static bool holds(const Collider& collider);
    void add(const Collider& collider, size_t number, size_t material);
    bool empty() const { return spheres_.empty() && boxes_.empty() && capsules_.empty(); }

    struct Loops {
        std::string clearances, survey;  // statements of the functions of that name (compile/generate.h)
    };
    // Appends the texels.
    Loops write(std::vector<glm::vec4>& samples) const;

  private:
    glm::dvec3 middle_{0};  // m
    std::vector<glm::vec4> spheres_, boxes_, capsules_;
};

}  // namespace shoal
