// How a window looks at a scene, and where in the window a place of the scene is.
#pragma once

#include <functional>
#include <optional>

#include <imgui.h>

#include "render/view.h"
#include "scene/scene.h"

namespace shoal::window {

// y of the highest ground at x and z, m: of planes that face up and of height fields that stand still;
// minus infinity: there is none.
double groundHeight(const Scene& scene, double x, double z);

// Orbit, pan and zoom about a target: left drag turns, right or middle drag pans, the wheel zooms. The eye
// stays above the ground, unless it starts below.
class OrbitCamera {
  public:
    using Ground = std::function<double(double x, double z)>;  // as groundHeight()
    explicit OrbitCamera(const View& start) : start_(start) { reset(); }

    void turn(double dx, double dy);  // in window heights
    void pan(double dx, double dy);   // in window heights
    void zoom(double steps);          // of the wheel, towards the target
    // From a direction, about the same target: radians around from +z towards +x, and above the horizon.
    void lookFrom(double azimuth, double elevation);
    void follow(const glm::dvec3& target) { target_ = target; }
    void reset();
    void start(const View& view);  // where reset() goes; goes there when it is another place than before
    View view() const;
    void standOn(Ground ground) { ground_ = std::move(ground); }

  private:
    double least(const glm::dvec3& eye) const;  // y, above the ground
    void rise();                                // as far as the eye would be below that

    View start_;
    Ground ground_;
    glm::dvec3 target_{0};
    double distance_ = 1, azimuth_ = 0, elevation_ = 0;  // m, rad
};

// From the scene to places in the window and back. Places: in the interface's units, from the upper left.
class Projector {
  public:
    Projector(const View& view, ImVec2 size);

    std::optional<ImVec2> place(const glm::dvec3& point) const;  // nothing: behind the eye
    double depth(const glm::dvec3& point) const;                 // m, from the eye
    // Where the ray through a place meets the plane through `point` that faces the eye.
    glm::dvec3 onPlane(ImVec2 place, const glm::dvec3& point) const;

  private:
    glm::dvec3 eye_;
    glm::dmat3 directions_;  // directionsOf()
    double tangent_;         // of half the field of view
    ImVec2 size_;
};

}  // namespace shoal::window
