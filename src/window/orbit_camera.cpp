#include "window/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace shoal::window {

static constexpr double steepest = 1.55;  // rad: short of the poles, where up is undefined

OrbitCamera::OrbitCamera(const View& start) : start_(start) {
    reset();
}

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

}  // namespace shoal::window
