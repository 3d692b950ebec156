// Towers: solid molecules that start on one another. What a contact has to carry passes on by one level an
// iteration, so tall towers take more of these than heaps do.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace shoal {

glm::dmat3 uprightAxes(const glm::dvec3& gravity);  // y is up

struct ContactGroup;
struct GroupPlan;

struct Tower {
    static constexpr int alwaysStands = 5;  // at the defaults, of 2 cm and more a level

    int levels = 0;     // 0: nothing stands on anything
    double height = 0;  // m, of a level
    size_t group = 0;   // in the plan, of the lowest
};

// Finds the tallest: each molecule within a radius of contact above the one below, and its middle less than a
// quarter of its width aside.
Tower tallestTower(const Scene& scene, const std::vector<GroupPlan>& groups,
                   const std::vector<ContactGroup>& contacts);

}  // namespace shoal
