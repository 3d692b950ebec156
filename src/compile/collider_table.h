// Colliders that uniforms have no room for: those that stand still, can be crossed and read no samples, as
// loops over the shared table of samples, so that their number is not in the text's length. Texels of a
// collider: the numbers of its call (scene/collider_kinds.h) and its thickness, each in the first room that
// is left for it (NumberLayout), and in z and w of the last its number and its material.
//
// material: index of the uniform whose x is the restitution and y the friction. Where one float is not enough
// for some of their places, all are relative to a point of the anchors' lattice amid them, in a texel before
// theirs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace shoal {

class ColliderTable {
  public:
    // Chooses the table's origin from those of the colliders that it can hold; add() fills it.
    explicit ColliderTable(const std::vector<Collider>& colliders);
    // Whether a collider can lie in the table.
    static bool holds(const Collider& collider);
    void add(const Collider& collider, size_t number, size_t material);
    bool empty() const { return kinds_.empty(); }

    struct Loops {
        std::string clearances, survey,
            nearest;  // statements of the functions of that name (compile/generate.h)
    };
    // Appends the texels.
    Loops write(std::vector<glm::vec4>& samples) const;

  private:
    struct Kind {
        std::string name;                // in the plural
        std::string surface, thickness;  // text: from t0 ...
        size_t read = 0;                 // texels of one that these need
        size_t count = 0;
        std::vector<glm::vec4> texels;
        size_t texelsOfOne() const { return texels.size() / count; }
    };
    bool isFar() const { return middle_ != glm::dvec3(0); }
    static std::string loopOver(const Kind& kind, size_t base, size_t read, const std::string& body);

    glm::dvec3 middle_{0};          // m
    std::map<size_t, Kind> kinds_;  // by the index of the alternative
};

}  // namespace shoal
