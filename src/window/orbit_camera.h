// Orbit, pan and zoom about a target: left drag turns, right or middle drag pans, the wheel zooms.
#pragma once

#include "render/view.h"

namespace shoal::window {

class OrbitCamera {
  public:
    explicit OrbitCamera(const View& start);

    void turn(double dx, double dy);  // in window heights
    void pan(double dx, double dy);   // in window heights
    void zoom(double steps);          // of the wheel, towards the target
    // From a direction, about the same target: radians around from +z towards +x, and above the horizon.
    void lookFrom(double azimuth, double elevation);
    void follow(const glm::dvec3& target) { target_ = target; }
    void reset();
    void start(const View& view);  // where reset() goes; goes there when it is another place than before
    View view() const;

  private:
    View start_;
    glm::dvec3 target_{0};
    double distance_ = 1, azimuth_ = 0, elevation_ = 0;  // m, rad
};

}  // namespace shoal::window
