#include "compile/collider_kinds.h"

#include <algorithm>
#include <cmath>

namespace shoal {

namespace {

constexpr double leastAxis = 1e-9;  // m: ends of a capsule that are nearer coincide

// A unit vector across an axis of any length.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 out = glm::cross(axis / std::max({size.x, size.y, size.z, 1e-300}), other);
    return glm::length(out) > 0 ? glm::normalize(out) : glm::dvec3(0, 1, 0);
}

double reach(const PlaneCollider&) {
    return 0;
}
double reach(const HeightFieldCollider&) {
    return 0;
}
double reach(const SphereCollider& sphere) {
    return glm::length(sphere.center) + sphere.radius;
}
double reach(const BoxCollider& box) {
    return glm::length(box.center) + glm::length(box.size) / 2;
}
double reach(const DistanceFieldCollider& collider) {
    const SampleGrid& grid = collider.field.grid;
    const glm::dvec3 high = grid.low + grid.cell * glm::dvec3(grid.size - 1);
    return glm::length(glm::max(glm::abs(grid.low), glm::abs(high)));
}
double reach(const CapsuleCollider& capsule) {
    return std::max(glm::length(capsule.from), glm::length(capsule.to)) + capsule.radius;
}

}  // namespace

bool isSwept(const ColliderShape& shape) {
    return !std::holds_alternative<PlaneCollider>(shape) &&
           !std::holds_alternative<HeightFieldCollider>(shape);
}

double reachOf(const Collider& collider) {
    return collider.thickness + std::visit([](const auto& shape) { return reach(shape); }, collider.shape);
}

glm::dvec3 placeOf(const ColliderShape& shape) {
    if (const auto* plane = std::get_if<PlaneCollider>(&shape)) return plane->point;
    if (const auto* sphere = std::get_if<SphereCollider>(&shape)) return sphere->center;
    if (const auto* box = std::get_if<BoxCollider>(&shape)) return box->center;
    if (const auto* capsule = std::get_if<CapsuleCollider>(&shape)) return capsule->from;
    if (const auto* field = std::get_if<HeightFieldCollider>(&shape)) return {field->low.x, 0, field->low.y};
    return std::get<DistanceFieldCollider>(shape).field.grid.low;
}

CapsuleAxis axisOf(const CapsuleCollider& capsule) {
    glm::dvec3 along = capsule.to - capsule.from;
    if (glm::length(along) < leastAxis) along = {};
    const double squared = glm::dot(along, along);
    return {along, squared > 0 ? 1 / squared : 0, across(along)};
}

}  // namespace shoal
