// Colliders that uniforms have no room for: those that stand still, can be crossed and read no samples, as
// loops over the shared table of samples, so that their number is not in the text's length. Texels of a
// collider: the numbers of its call (scene/collider_kinds.h) and its thickness, each in the first room that
// is left for it (NumberLayout), and in z and w of the last its number and its material.
//
// What lies together is one cluster, behind a ball around it (a texel before all colliders of its kind: xyz
// the middle, w the radius, m): a cluster that is too far away to matter is passed over.
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
        // Statements of the functions of that name (compile/generate.h).
        std::string clearances, survey, nearest;
        std::string gather;  // gatherNear(), by which survey() knows what is near
    };
    // Appends the texels.
    Loops write(std::vector<glm::vec4>& samples) const;
    // About how often the loops of a look at all turn.
    size_t turns() const;

    static constexpr size_t clusterSize = 16;
    static constexpr int mostTurns =
        1 << 20;  // of a molecule on its ways through a frame: 0.1 s of a GPU's lane
    // All rasterisers take so many of a vertex in a substep of the ping-pong path.
    static constexpr int mostTurnsOfPass = mostTurns / 32;
    static constexpr size_t mostNear = 16;  // that a vertex has a list of; with more it looks at all
    struct Member {
        glm::dvec3 place;  // m, from the table's origin
        double reach = 0;  // m, of a ball around it, with its thickness
        size_t number = 0;
        std::vector<glm::vec4> texels;
    };

  private:
    struct Kind {
        std::string surface, thickness;  // text: from t0 ...
        size_t read = 0;                 // texels of one that these need
        std::vector<Member> members;
        size_t texelsOfOne() const { return members.front().texels.size(); }
    };
    bool isFar() const { return middle_ != glm::dvec3(0); }
    // Reads member n, whose kind's texels begin at `first`, and uses its `surface`.
    static std::string memberText(const Kind& kind, size_t first, size_t read, const std::string& use);
    // `limit`: text of a distance, m, from which on nothing matters.
    std::string loopOver(const Kind& kind, size_t base, size_t read, const std::string& limit,
                         const std::string& use) const;

    glm::dvec3 middle_{0};          // m
    std::map<size_t, Kind> kinds_;  // by the index of the alternative
};

}  // namespace shoal
