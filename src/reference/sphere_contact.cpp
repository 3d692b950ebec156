#include "reference/sphere_contact.h"

#include <algorithm>

#include "compile/contact_plan.h"

namespace shoal::reference {

// The least distance of two spheres in the last `step` s.
static double leastDistance(const Sphere& a, const Sphere& b, double step) {
    const glm::dvec3 d = a.position - b.position, u = a.velocity - b.velocity;
    const double fast = glm::dot(u, u);
    const double nearest = fast > 0 ? std::clamp(glm::dot(d, u) / fast, 0.0, step) : 0;
    return glm::length(d - u * nearest);
}

std::vector<std::pair<int, int>> touching(const std::vector<Sphere>& spheres, double step) {
    std::vector<std::pair<int, int>> out;
    for (size_t a = 0; a < spheres.size(); ++a) {
        for (size_t b = a + 1; b < spheres.size(); ++b) {
            const double reach = spheres[a].radius + spheres[b].radius;
            const double distance = glm::distance(spheres[a].position, spheres[b].position);
            const bool touch =
                distance < ContactPlan::near * reach || leastDistance(spheres[a], spheres[b], step) < reach;
            if (touch && spheres[a].molecule != spheres[b].molecule) out.emplace_back(int(a), int(b));
        }
    }
    return out;
}

}  // namespace shoal::reference
