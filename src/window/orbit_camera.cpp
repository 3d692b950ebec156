#include "window/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/known_colliders.h"

namespace shoal::window {

double groundHeight(const Scene& scene, double x, double z) {
    double out = -std::numeric_limits<double>::infinity();
    for (const Collider& collider : scene.colliders) {
        if (collider.path) continue;
        const auto* plane = kindOf<PlaneCollider>(*collider.shape);
        const auto* field = kindOf<HeightFieldCollider>(*collider.shape);
        constexpr double facesUp = 0.5;
        if (plane && plane->normal.y > facesUp) {
            const glm::dvec3 arm = glm::dvec3(x, 0, z) - glm::dvec3(plane->point.x, 0, plane->point.z);
            out = std::max(out, plane->point.y - glm::dot(plane->normal, arm) / plane->normal.y);
        }
        if (!field) continue;
        const glm::dvec2 cells(field->columns - 1, field->rows - 1);
        const glm::dvec2 place = (glm::dvec2(x, z) - field->low) / (field->high - field->low) * cells;
        if (!(place.x >= 0 && place.y >= 0 && place.x <= cells.x && place.y <= cells.y)) continue;
        for (int corner = 0; corner < 4; ++corner) {  // of the cell: no lower than the surface
            const size_t column = size_t(corner & 1 ? std::ceil(place.x) : std::floor(place.x));
            const size_t row = size_t(corner & 2 ? std::ceil(place.y) : std::floor(place.y));
            out = std::max(out, field->level + double(field->heights[row * size_t(field->columns) + column]));
        }
    }
    return out;
}

static constexpr double steepest = 1.55;  // rad: short of the poles, where up is undefined

void OrbitCamera::reset() {
    const glm::dvec3 arm = start_.eye - start_.target;
    target_ = start_.target;
    distance_ = std::max(glm::length(arm), 1e-3);
    azimuth_ = std::atan2(arm.x, arm.z);
    elevation_ = std::asin(std::clamp(arm.y / distance_, -1.0, 1.0));
}

void OrbitCamera::start(const View& view) {
    const bool moved = view.eye != start_.eye || view.target != start_.target;
    start_ = view;
    if (moved) reset();
}

void OrbitCamera::lookFrom(double azimuth, double elevation) {
    azimuth_ = azimuth;
    elevation_ = std::clamp(elevation, -steepest, steepest);
    rise();
}

void OrbitCamera::turn(double dx, double dy) {
    azimuth_ -= 4 * dx;
    elevation_ = std::clamp(elevation_ + 4 * dy, -steepest, steepest);
    rise();
}

void OrbitCamera::pan(double dx, double dy) {
    const glm::dvec3 ahead = glm::normalize(target_ - view().eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const double metres = 2 * distance_ * std::tan(start_.fieldOfView / 2);
    target_ += (-dx * right + dy * glm::cross(right, ahead)) * metres;
}

void OrbitCamera::zoom(double steps) {
    distance_ = std::clamp(distance_ * std::pow(0.9, steps), 0.02, 1e5);
}

double OrbitCamera::least(const glm::dvec3& eye) const {
    constexpr double clearance = 0.02;  // of the distance to the target
    const auto height = [&](const glm::dvec3& place) { return ground_(place.x, place.z); };
    if (!ground_ || start_.eye.y < height(start_.eye)) return -std::numeric_limits<double>::infinity();
    return height(eye) + clearance * distance_;
}

// Where a turn ends, so that the way back begins there. The ground is another at another place: a second look
// comes close, and view() takes the rest.
void OrbitCamera::rise() {
    for (int look = 0; look < 2; ++look) {
        const double level = std::cos(elevation_);
        const glm::dvec3 arm(level * std::sin(azimuth_), std::sin(elevation_), level * std::cos(azimuth_));
        const double sine = (least(target_ + distance_ * arm) - target_.y) / distance_;
        if (arm.y < sine) elevation_ = std::clamp(std::asin(std::min(sine, 1.0)), elevation_, steepest);
    }
}

View OrbitCamera::view() const {
    View out = start_;
    const double level = std::cos(elevation_);
    out.target = target_;
    out.eye = target_ + distance_ * glm::dvec3(level * std::sin(azimuth_), std::sin(elevation_),
                                               level * std::cos(azimuth_));
    out.eye.y = std::max(out.eye.y, least(out.eye));
    return out;
}

Projector::Projector(const View& view, ImVec2 size)
    : eye_(view.eye),
      directions_(directionsOf(view)),
      tangent_(std::tan(view.fieldOfView / 2)),
      size_(size) {}

double Projector::depth(const glm::dvec3& point) const {
    return -glm::dot(point - eye_, directions_[2]);
}

std::optional<ImVec2> Projector::place(const glm::dvec3& point) const {
    const double deep = depth(point);
    if (!(deep > 1e-6)) return std::nullopt;
    const double half = size_.y / 2 / (deep * tangent_);
    const glm::dvec3 arm = point - eye_;
    return ImVec2(float(size_.x / 2 + glm::dot(arm, directions_[0]) * half),
                  float(size_.y / 2 - glm::dot(arm, directions_[1]) * half));
}

glm::dvec3 Projector::onPlane(ImVec2 place, const glm::dvec3& point) const {
    const double deep = std::max(depth(point), 1e-6), scale = deep * tangent_ / (size_.y / 2);
    return eye_ - directions_[2] * deep + directions_[0] * ((place.x - size_.x / 2) * scale) -
           directions_[1] * ((place.y - size_.y / 2) * scale);
}

}  // namespace shoal::window
