// Spheres that overlap, and what pushes them apart.
#include <algorithm>

#include "gl/marbles.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;

TEST_CASE("marbles in one place all part, none faster than overlaps are pushed apart", "[overlap]") {
    const Path path = pathHere();
    const double radius = 0.05;
    const Scene scene = marbles(std::vector<dvec3>(125, {0.3, 0.2, 0.1}), radius);
    Simulation simulation = simulationOn(path, compile(scene));
    std::vector<reference::Sphere> before = statesOf(simulation);
    double fastest = 0, moved = 0;
    for (int i = 0; i < 200; ++i) {
        simulation.frame();
        const std::vector<reference::Sphere> after = statesOf(simulation);
        for (size_t m = 0; m < after.size(); ++m) {
            fastest = std::max(fastest, glm::length(after[m].velocity));
            moved = std::max(moved, glm::distance(after[m].position, before[m].position) / 0.01);
        }
        before = after;
    }
    double nearest = 1e30;
    for (size_t a = 0; a < before.size(); ++a)
        for (size_t b = 0; b < a; ++b)
            nearest = std::min(nearest, glm::distance(before[a].position, before[b].position));
    CAPTURE(name(path), fastest, moved, nearest / (2 * radius));
    CHECK(fastest < 1e-3);
    CHECK(moved < 1.001);
    CHECK(nearest > 0.99 * 2 * radius);
}

}  // namespace shoal
