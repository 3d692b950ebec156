#include "window/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace shoal::window {

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
}

void OrbitCamera::turn(double dx, double dy) {
    azimuth_ -= 4 * dx;
    elevation_ = std::clamp(elevation_ + 4 * dy, -steepest, steepest);
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

View OrbitCamera::view() const {
    View out = start_;
    const double level = std::cos(elevation_);
    out.target = target_;
    out.eye = target_ + distance_ * glm::dvec3(level * std::sin(azimuth_), std::sin(elevation_),
                                               level * std::cos(azimuth_));
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
