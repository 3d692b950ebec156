// Meshes made in code for the tests.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "geometry/mesh.h"

namespace shoal::test {

// Appends a closed tube of `sides` sides about a vertical axis through `foot`, capped at both ends, as an
// object of its own. Vertices lie on the true cylinder.
inline void addTube(Mesh& mesh, const std::string& name, glm::dvec3 foot, double radius, double height,
                    int sides, int rings) {
    const int first = static_cast<int>(mesh.positions.size());
    Mesh::Object object{name, static_cast<int>(mesh.triangles.size()), 0};
    for (int ring = 0; ring <= rings; ++ring)
        for (int side = 0; side < sides; ++side) {
            const double angle = 2 * std::numbers::pi * side / sides;
            mesh.positions.push_back(foot + glm::dvec3(radius * std::cos(angle), height * ring / rings,
                                                       -radius * std::sin(angle)));
        }
    const int low = static_cast<int>(mesh.positions.size()), high = low + 1;
    mesh.positions.push_back(foot);
    mesh.positions.push_back(foot + glm::dvec3(0, height, 0));
    for (int side = 0; side < sides; ++side) {
        const int next = (side + 1) % sides;
        for (int ring = 0; ring < rings; ++ring) {
            const int a = first + ring * sides + side, b = first + ring * sides + next;
            mesh.triangles.push_back({a, b, b + sides});
            mesh.triangles.push_back({a, b + sides, a + sides});
        }
        mesh.triangles.push_back({low, first + next, first + side});
        mesh.triangles.push_back({high, first + rings * sides + side, first + rings * sides + next});
    }
    object.triangleCount = static_cast<int>(mesh.triangles.size()) - object.firstTriangle;
    mesh.objects.push_back(object);
}

// A square in the plane y = 0 about the origin, seen from above, of two triangles.
inline Mesh square(double side) {
    Mesh mesh;
    const double h = side / 2;
    mesh.positions = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.objects = {{"square", 0, 2}};
    completeMesh(mesh);
    return mesh;
}

}  // namespace shoal::test
