// Marbles and quads in contact with one another, what the reference makes of them, and what they come to.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "reference/sphere_response.h"

namespace shoal::test {

using Pairs = std::vector<std::pair<int, int>>;

// Those that the context can run.
Simulation simulationOn(Path path, Plan plan, bool drawn = false);
// Points of some masses, each with contact of one radius, in no gravity.
Scene marbles(const std::vector<glm::dvec3>& positions, double radius, double mass = 1);
// With these velocities, group by group, and materials for all pairs of groups.
Simulation startedWith(const Scene& scene, const std::vector<glm::dvec3>& velocities, glm::vec2 material,
                       Path path = pathHere());
// All spheres of the plan's start state, in the order of their numbers.
std::vector<reference::Sphere> spheresOf(const Plan& plan);
// Returns the pairs of `some` that `all` lacks.
Pairs missing(const Pairs& all, const Pairs& some);
// Marbles in clusters that are far from one another, a group of them for each mass.
class Clusters {
  public:
    explicit Clusters(size_t masses) : places_(masses), velocities_(masses), owners_(masses) {}

    void add(size_t mass, const glm::dvec3& place, const glm::dvec3& velocity, size_t cluster);
    // `factor`: of each mass to the last; the first is 1 kg.
    Scene scene(double radius, double factor) const;
    // As statesOf() has the marbles.
    std::vector<glm::dvec3> velocities() const;
    std::vector<size_t> owners() const;

  private:
    std::vector<std::vector<glm::dvec3>> places_, velocities_;
    std::vector<std::vector<size_t>> owners_;
};
// Quads strewn over a box, with contact.
Scene strewn(int count, const glm::dvec3& size, double radius, glm::dvec2 scale = {1, 1});
// Positions and velocities of the vertices of all groups, in their order.
std::vector<reference::Sphere> statesOf(const Simulation& simulation);
glm::dvec3 momentum(const std::vector<reference::Sphere>& spheres);
// A regular one, whose springs make a rigid body of it.
Molecule tetrahedron(double edge, double mass);
// Spheres that move as one, in double precision. They start with the velocity of the first, without turning.
struct Body {
    double perMass = 0;  // 1/kg
    glm::dmat3 perInertia{0};
    glm::dvec3 center{0}, velocity{0}, spin{0};

    explicit Body(std::span<const reference::Sphere> spheres);
    glm::dvec3 velocityAt(const glm::dvec3& arm) const { return velocity + glm::cross(spin, arm); }
    void push(const glm::dvec3& impulse, const glm::dvec3& arm) {
        velocity += impulse * perMass;
        spin += perInertia * glm::cross(arm, impulse);
    }
    // How 1 N s along a direction changes the velocity along it, 1/kg.
    double weight(const glm::dvec3& direction, const glm::dvec3& arm) const {
        const glm::dvec3 across = glm::cross(arm, direction);
        return perMass + glm::dot(across, perInertia * across);
    }
};

}  // namespace shoal::test
