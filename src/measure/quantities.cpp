#include "measure/quantities.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/point_tree.h"

namespace shoal::measure {

namespace {

glm::dvec3 meanOf(const std::vector<glm::dvec3>& vectors) {
    glm::dvec3 out(0);
    for (const glm::dvec3& vector : vectors)
        out += vector / double(vectors.size());
    return out;
}

// One number a molecule.
template <typename Function>
std::vector<double> each(const std::vector<glm::dvec3>& vectors, Function number) {
    std::vector<double> out;
    out.reserve(vectors.size());
    for (const glm::dvec3& vector : vectors)
        out.push_back(number(vector));
    return out;
}

}  // namespace

Centers centersOf(const Snapshot& snapshot, const std::vector<double>& masses) {
    double mass = 0;
    for (const double m : masses)
        mass += m;
    Centers out;
    for (int m = 0; m < snapshot.count; ++m) {
        if (!snapshot.alive.empty() && !snapshot.alive[size_t(m)]) continue;
        glm::dvec3 position(0), velocity(0);
        for (size_t v = 0; v < masses.size(); ++v) {
            const size_t i = size_t(m) * masses.size() + v;
            position += masses[v] / mass * snapshot.positions[i];
            velocity += masses[v] / mass * snapshot.velocities[i];
        }
        out.positions.push_back(position);
        out.velocities.push_back(velocity);
        out.molecules.push_back(m);
    }
    return out;
}

std::vector<double> heights(const Centers& centers, const glm::dvec3& up) {
    return each(centers.positions, [&](const glm::dvec3& position) { return glm::dot(position, up); });
}

std::vector<double> spreads(const Centers& centers) {
    const glm::dvec3 mean = meanOf(centers.positions);
    return each(centers.positions, [&](const glm::dvec3& position) { return glm::length(position - mean); });
}

std::vector<double> speeds(const Centers& centers) {
    return each(centers.velocities, [](const glm::dvec3& velocity) { return glm::length(velocity); });
}

std::vector<double> nearestDistances(const Centers& centers) {
    const PointTree tree(centers.positions);
    std::vector<double> out;
    for (size_t i = 0; i < centers.size(); ++i)
        out.push_back(tree.nearestDistance(i));
    return out;
}

std::vector<double> alignments(const Centers& centers, double slowest) {
    std::vector<glm::dvec3> units;
    for (const glm::dvec3& velocity : centers.velocities) {
        const double speed = glm::length(velocity);
        units.push_back(speed > slowest ? velocity / speed : glm::dvec3(0));
    }
    const glm::dvec3 mean = meanOf(units);
    const double length = glm::length(mean);
    const glm::dvec3 direction = length > 0 ? mean / length : glm::dvec3(0);
    return each(units, [&](const glm::dvec3& unit) { return glm::dot(unit, direction); });
}

double commonVolume(double distance, double first, double second) {
    const double depth = first + second - distance, difference = first - second,
                 smaller = std::min(first, second);
    if (depth <= 0) return 0;
    if (distance <= std::abs(difference)) return 4 * std::numbers::pi / 3 * smaller * smaller * smaller;
    return std::numbers::pi * depth * depth *
           (distance * distance + 2 * distance * (first + second) - 3 * difference * difference) /
           (12 * distance);
}

std::vector<double> packings(const Centers& centers, const std::vector<glm::dvec3>& spheres,
                             const std::vector<double>& radii, double radius) {
    const PointTree tree(spheres);
    const double largest = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
    const double ball = 4 * std::numbers::pi / 3 * radius * radius * radius;
    return each(centers.positions, [&](const glm::dvec3& center) {
        double filled = 0;
        tree.within(center, radius + largest, [&](size_t sphere) {
            filled += commonVolume(glm::length(spheres[sphere] - center), radius, radii[sphere]);
        });
        return filled / ball;
    });
}

double reposeAngle(const Centers& centers, const glm::dvec3& up) {
    const std::vector<double> height = heights(centers, up);
    const double lowest = *std::min_element(height.begin(), height.end()), n = double(height.size());
    const glm::dvec3 mean = meanOf(centers.positions);
    double meanHeight = 0, squares = 0;
    for (size_t i = 0; i < height.size(); ++i) {
        const glm::dvec3 away = centers.positions[i] - mean;
        const double above = glm::dot(away, up);
        meanHeight += (height[i] - lowest) / n;
        squares += (glm::dot(away, away) - above * above) / n;
    }
    return std::atan2(4 * meanHeight, std::sqrt(10 * squares / 3));
}

}  // namespace shoal::measure
