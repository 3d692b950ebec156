#include "render/view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shoal {

View View::fromCamera(const Camera& camera, double time) {
    View view;
    view.time = time;
    view.eye = camera.eye;
    view.target = camera.target;
    view.fieldOfView = camera.fieldOfView;
    view.exposure = camera.exposure;
    return view;
}

Origin::Origin(const glm::dvec3& point) : exact(point) {
    const glm::dvec3 below = glm::floor(point * 16.0) / 16.0;
    lattice = glm::vec3(below);
    rest = glm::vec3(point - below);
}

void Origin::apply(const gpu::Program& program) const {
    program.set("originLattice", lattice);
    program.set("originRest", rest);
}

// Any direction that is not along `axis`.
static glm::dvec3 acrossFrom(const glm::dvec3& axis, const glm::dvec3& wanted) {
    const glm::dvec3 across = glm::cross(wanted, axis);
    if (glm::length(across) > 1e-6) return glm::normalize(across);
    return glm::normalize(
        glm::cross(std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1), axis));
}

glm::dmat3 directionsOf(const View& view) {
    const glm::dvec3 away = view.eye - view.target;
    const double distance = glm::length(away);
    const glm::dvec3 back = distance > 0 ? away / distance : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = acrossFrom(back, view.up);
    return {right, glm::cross(back, right), back};
}

Eye::Eye(const View& view, int width, int height) : origin(view.eye) {
    const double distance = glm::length(view.eye - view.target);
    const double tangent = std::tan(view.fieldOfView / 2), aspect = double(width) / double(height);
    // Near enough to walk up to what is looked at, far enough for a 24-bit depth buffer to tell leaves apart.
    const double near = std::clamp(0.02 * distance, 0.002, 0.5);

    const glm::dmat3 toScene = directionsOf(view);
    viewToScene = glm::mat3(toScene);
    toClip = glm::mat4(glm::infinitePerspective(view.fieldOfView, aspect, near) *
                       glm::dmat4(glm::transpose(toScene)));
    tangents = glm::vec2(tangent * aspect, tangent);
    pixelsPerMeter = float(height / (2 * tangent));
    size = glm::vec2(width, height);
    nearest = float(near);
    time = view.time;
}

}  // namespace shoal
