#include "reference/sphere_contact.h"

#include "compile/contact_plan.h"

namespace shoal::reference {

std::vector<std::pair<int, int>> touching(const std::vector<Sphere>& spheres) {
    std::vector<std::pair<int, int>> out;
    for (size_t a = 0; a < spheres.size(); ++a) {
        for (size_t b = a + 1; b < spheres.size(); ++b) {
            const double limit = ContactPlan::near * (spheres[a].radius + spheres[b].radius);
            const glm::dvec3 d = spheres[a].position - spheres[b].position;
            if (glm::dot(d, d) < limit * limit && spheres[a].molecule != spheres[b].molecule)
                out.emplace_back(int(a), int(b));
        }
    }
    return out;
}

}  // namespace shoal::reference
