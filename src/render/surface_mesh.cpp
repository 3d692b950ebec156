#include "render/surface_mesh.h"

#include <cmath>
#include <numbers>

namespace shoal {

using std::numbers::pi;

SurfaceMesh meshOf(const Mesh& mesh) {
    SurfaceMesh out;
    out.origin = glm::floor(0.5 * (mesh.low + mesh.high));
    out.corners.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        SurfaceMesh::Corner corner;
        corner.position = glm::vec3(mesh.positions[i] - out.origin);
        corner.normal = glm::vec3(mesh.normals[i]);
        if (!mesh.colors.empty()) corner.color = glm::vec3(mesh.colors[i]);
        out.corners.push_back(corner);
    }
    out.indices.reserve(mesh.triangles.size() * 3);
    for (const glm::ivec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k)
            out.indices.push_back(uint32_t(t[k]));
    }
    return out;
}

// Two triangles for each cell of a grid whose row `i` starts at i * (across + 1).
static void addCells(SurfaceMesh& mesh, int down, int across) {
    for (int i = 0; i < down; ++i) {
        for (int j = 0; j < across; ++j) {
            const uint32_t a = uint32_t(i * (across + 1) + j), b = a + uint32_t(across) + 1;
            for (const uint32_t corner : {a, b, a + 1, a + 1, b, b + 1})
                mesh.indices.push_back(corner);
        }
    }
}

SurfaceMesh sphereMesh(const SphereCollider& sphere) {
    constexpr int rings = 48, segments = 96;
    SurfaceMesh out;
    out.origin = sphere.center;
    for (int i = 0; i <= rings; ++i) {
        const double polar = pi * i / rings;
        for (int j = 0; j <= segments; ++j) {
            const double turn = 2 * pi * j / segments;
            const glm::dvec3 n(std::sin(polar) * std::sin(turn), std::cos(polar),
                               std::sin(polar) * std::cos(turn));
            out.corners.push_back({glm::vec3(sphere.radius * n), glm::vec3(n), glm::vec3(1)});
        }
    }
    addCells(out, rings, segments);
    return out;
}

SurfaceMesh boxMesh(const BoxCollider& box) {
    SurfaceMesh out;
    out.origin = box.center;
    const glm::dmat3 turn = glm::mat3_cast(box.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // so that the corners go round anticlockwise
            v[(axis + 2) % 3] = 1;
            const uint32_t first = uint32_t(out.corners.size());
            for (const glm::dvec2 at : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const glm::dvec3 place = 0.5 * box.size * (n + at.x * u + at.y * v);
                out.corners.push_back({glm::vec3(turn * place), glm::vec3(turn * n), glm::vec3(1)});
            }
            for (const uint32_t corner : {0, 1, 2, 0, 2, 3})
                out.indices.push_back(first + corner);
        }
    }
    return out;
}

// A sphere cut in two at its equator, the halves moved to the ends.
SurfaceMesh capsuleMesh(const CapsuleCollider& capsule) {
    constexpr int rings = 24, segments = 64;
    SurfaceMesh out;
    out.origin = capsule.from;
    const glm::dvec3 span = capsule.to - capsule.from;
    const double length = glm::length(span);
    const glm::dvec3 axis = length > 0 ? span / length : glm::dvec3(0, 1, 0);
    const auto [along, across] = tangentsOf(axis);
    for (int i = 0; i < 2 * rings; ++i) {
        const bool far = i < rings;  // the equator twice, once at each end
        const double polar = pi * (far ? i : i - 1) / (2 * (rings - 1));
        for (int j = 0; j <= segments; ++j) {
            const double turn = 2 * pi * j / segments;
            const glm::dvec3 n =
                std::cos(polar) * axis + std::sin(polar) * (std::cos(turn) * along + std::sin(turn) * across);
            out.corners.push_back(
                {glm::vec3(capsule.radius * n + (far ? span : glm::dvec3(0))), glm::vec3(n), glm::vec3(1)});
        }
    }
    addCells(out, 2 * rings - 1, segments);
    return out;
}

std::pair<glm::dvec3, glm::dvec3> tangentsOf(const glm::dvec3& normal) {
    const glm::dvec3 start = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 along = glm::normalize(start - glm::dot(start, normal) * normal);
    return {along, glm::cross(along, normal)};
}

SurfaceMesh discMesh(const glm::dvec3& normal) {
    constexpr int rings = 24, segments = 64;
    const auto [along, across] = tangentsOf(normal);
    SurfaceMesh out;
    for (int i = 0; i <= rings; ++i) {
        const double radius = std::pow(double(i) / rings, 3);
        for (int j = 0; j <= segments; ++j) {
            const double turn = 2 * pi * j / segments;
            const glm::dvec3 place = radius * (std::cos(turn) * along + std::sin(turn) * across);
            out.corners.push_back({glm::vec3(place), glm::vec3(normal), glm::vec3(1)});
        }
    }
    addCells(out, rings, segments);
    return out;
}

}  // namespace shoal
