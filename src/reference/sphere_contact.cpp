#include "reference/sphere_contact.h"

#include <algorithm>

#include "compile/contact_plan.h"

namespace shoal::reference {

// Whether two spheres that approached `step` s ago have touched since.
static bool haveMet(const Sphere& a, const Sphere& b, double step) {
    const glm::dvec3 d = a.position - b.position, u = a.velocity - b.velocity;
    const double fast = glm::dot(u, u), reach = a.radius + b.radius;
    const double nearest = fast > 0 ? std::clamp(glm::dot(d, u) / fast, 0.0, step) : 0;
    return glm::dot(d - u * step, u) < 0 && glm::length(d - u * nearest) < reach;
}

std::vector<std::pair<int, int>> touching(const std::vector<Sphere>& spheres, double step) {
    std::vector<std::pair<int, int>> out;
    for (size_t a = 0; a < spheres.size(); ++a) {
        for (size_t b = a + 1; b < spheres.size(); ++b) {
            const double reach = spheres[a].radius + spheres[b].radius;
            const double distance = glm::distance(spheres[a].position, spheres[b].position);
            const bool touch = distance < ContactPlan::near * reach || haveMet(spheres[a], spheres[b], step);
            if (touch && spheres[a].molecule != spheres[b].molecule) out.emplace_back(int(a), int(b));
        }
    }
    return out;
}

}  // namespace shoal::reference
