#include "scene/collider_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/collider_kinds.h"

namespace shoal {

std::pair<glm::dvec3, glm::dvec3> tangentsOf(const glm::dvec3& normal) {
    const glm::dvec3 start = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 along = glm::normalize(start - glm::dot(start, normal) * normal);
    return {along, glm::cross(along, normal)};
}

namespace {

using std::numbers::pi;

struct Corner {
    glm::vec3 position{0}, normal{0};
};

void add(ColliderMesh& mesh, const Corner& corner) {
    mesh.positions.push_back(corner.position);
    mesh.normals.push_back(corner.normal);
}

// Adds rings of corners, each of which ends where it began, and two triangles between any four of them.
// `corner` makes that of a ring at a turn, rad.
template <typename MakeCorner>
void addRings(ColliderMesh& mesh, int rings, int segments, const MakeCorner& corner) {
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j <= segments; ++j)
            add(mesh, corner(i, 2 * pi * j / segments));
    for (int i = 0; i + 1 < rings; ++i)
        for (int j = 0; j < segments; ++j) {
            const uint32_t a = uint32_t(i * (segments + 1) + j), b = a + uint32_t(segments) + 1;
            mesh.corners.insert(mesh.corners.end(), {a, b, a + 1, a + 1, b, b + 1});
        }
}

ColliderMesh meshOf(const SphereCollider& sphere) {
    constexpr int rings = 48, segments = 96;
    ColliderMesh out;
    out.origin = sphere.center;
    addRings(out, rings + 1, segments, [&](int i, double turn) {
        const double polar = pi * i / rings;
        const glm::dvec3 n(std::sin(polar) * std::sin(turn), std::cos(polar),
                           std::sin(polar) * std::cos(turn));
        return Corner{glm::vec3(sphere.radius * n), glm::vec3(n)};
    });
    return out;
}

ColliderMesh meshOf(const BoxCollider& box) {
    ColliderMesh out;
    out.origin = box.center;
    const glm::dmat3 turn = glm::mat3_cast(box.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 n(0), u(0), v(0);
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // so that the corners go round anticlockwise
            v[(axis + 2) % 3] = 1;
            const uint32_t first = uint32_t(out.positions.size());
            for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const glm::dvec3 place = 0.5 * box.size * (n + corner.x * u + corner.y * v);
                add(out, {glm::vec3(turn * place), glm::vec3(turn * n)});
            }
            out.corners.insert(out.corners.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
        }
    }
    return out;
}

// A sphere cut in two at its equator, the halves moved to the ends.
ColliderMesh meshOf(const CapsuleCollider& capsule) {
    constexpr int rings = 24, segments = 64;
    ColliderMesh out;
    out.origin = capsule.from;
    const glm::dvec3 span = capsule.to - capsule.from;
    const double length = glm::length(span);
    const glm::dvec3 axis = length > 0 ? span / length : glm::dvec3(0, 1, 0);
    const auto [along, across] = tangentsOf(axis);
    addRings(out, 2 * rings, segments, [&, &u = along, &v = across](int i, double turn) {
        const bool far = i < rings;  // the equator twice, once at each end
        const double polar = pi * (far ? i : i - 1) / (2 * (rings - 1));
        const glm::dvec3 n =
            std::cos(polar) * axis + std::sin(polar) * (std::cos(turn) * u + std::sin(turn) * v);
        return Corner{glm::vec3(capsule.radius * n + (far ? span : glm::dvec3(0))), glm::vec3(n)};
    });
    return out;
}

// A disc of radius 1 around the origin; its rings are closer together in the middle, where the eye is.
ColliderMesh meshOf(const PlaneCollider& plane) {
    constexpr int rings = 24, segments = 64;
    const glm::dvec3 normal = glm::normalize(plane.normal);
    const auto [along, across] = tangentsOf(normal);
    ColliderMesh out;
    addRings(out, rings + 1, segments, [&, &u = along, &v = across](int i, double turn) {
        const double radius = std::pow(double(i) / rings, 3);
        const glm::dvec3 place = radius * (std::cos(turn) * u + std::sin(turn) * v);
        return Corner{glm::vec3(place), glm::vec3(normal)};
    });
    return out;
}

// Nothing: these are drawn as their models.
ColliderMesh meshOf(const HeightFieldCollider&) {
    return {};
}

ColliderMesh meshOf(const DistanceFieldCollider&) {
    return {};
}

}  // namespace

ColliderMesh colliderMesh(const Collider& collider) {
    return std::visit([](const auto& kind) { return meshOf(kind); }, *collider.shape);
}

PlaneDisc seenOf(const PlaneCollider& plane, const glm::dvec3& eye) {
    constexpr double reach = 60;   // heights of the eye above the plane
    constexpr double least = 150;  // m
    const glm::dvec3 normal = glm::normalize(plane.normal);
    const double height = glm::dot(eye - plane.point, normal);
    return {eye - height * normal, std::max(least, reach * std::abs(height))};
}

}  // namespace shoal
