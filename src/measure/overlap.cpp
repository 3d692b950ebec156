#include "measure/overlap.h"

#include <algorithm>
#include <cmath>

namespace shoal::measure {

namespace {

// The spheres of a group as they are.
class GroupSpheres {
  public:
    GroupSpheres(const Simulation& simulation, const ContactGroup& contact)
        : contact_(contact),
          vertices_(simulation.plan().groups[contact.group].vertexCount),
          state_(simulation.readMolecules(contact.group, 0,
                                          size_t(simulation.plan().groups[contact.group].count))) {}

    int moleculeOf(int sphere) const { return (sphere - contact_.firstSphere) / contact_.spheresOf; }

    // m; `sphere`: its number among all.
    glm::dvec3 center(int sphere) const {
        const int own = (sphere - contact_.firstSphere) % contact_.spheresOf;
        if (own < vertices_) return vertex(moleculeOf(sphere), own);
        const auto& [corners, parts] = contact_.points[size_t(own - vertices_)];
        glm::dvec3 sum(0);
        for (int c = 0; c < 3; ++c)
            sum += vertex(moleculeOf(sphere), corners[c]) * double(parts[c]);
        return sum / double(parts.x + parts.y + parts.z);
    }

    double radius(int sphere) const {
        const size_t m = size_t(moleculeOf(sphere));
        const double own = contact_.radius * double(state_.looks[m].x);
        if (state_.lives.empty()) return own;
        const double lived = double(state_.lives[m].x) / std::max(double(state_.lives[m].y), 1e-9);
        return own * glm::mix(contact_.growth.x, contact_.growth.y, std::min(lived, 1.0));
    }

  private:
    glm::dvec3 vertex(int molecule, int v) const {
        return glm::dvec3(state_.anchors[size_t(molecule)]) +
               glm::dvec3(state_.positions[size_t(molecule) * size_t(vertices_) + size_t(v)]);
    }

    const ContactGroup& contact_;
    int vertices_;
    GroupState state_;
};

}  // namespace

Overlap overlapOf(const Simulation& simulation) {
    const std::vector<ContactGroup>& groups = simulation.plan().contact.groups;
    std::vector<GroupSpheres> spheres;
    for (const ContactGroup& contact : groups)
        spheres.emplace_back(simulation, contact);
    const auto groupOf = [&](int sphere) {
        const auto after = std::upper_bound(
            groups.begin(), groups.end(), sphere,
            [](int number, const ContactGroup& group) { return number < group.firstSphere; });
        return size_t(after - groups.begin()) - 1;
    };
    Overlap out;
    for (const auto& [a, b] : simulation.contact()->found()) {
        const size_t groupA = groupOf(a), groupB = groupOf(b);
        const GroupSpheres &first = spheres[groupA], &second = spheres[groupB];
        const double radiusA = first.radius(a), radiusB = second.radius(b);
        const double depth = radiusA + radiusB - glm::distance(first.center(a), second.center(b));
        const double share = std::max(depth, 0.0) / std::min(radiusA, radiusB);
        ++out.contacts;
        out.rms += share * share;
        if (share <= out.largest) continue;
        out.largest = share;
        out.group = groups[groupA].group;
        out.molecule = first.moleculeOf(a);
    }
    out.rms = std::sqrt(out.rms / double(std::max<size_t>(1, out.contacts)));
    return out;
}

}  // namespace shoal::measure
