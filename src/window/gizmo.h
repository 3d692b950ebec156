// Handles of places in the picture: a ring that the pointer drags across the view, and for the one that the
// pointer met last three arms along which it moves, knobs for how far something reaches, and circles to turn
// it. What is under the pointer lights up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <imgui.h>
#include <glm/gtc/quaternion.hpp>

#include "render/view.h"
#include "simulate/pick.h"

namespace shoal::window {

struct GizmoHandle {
    std::string label;
    glm::dvec3 position{0};  // m
    bool movable = true;     // else it only turns or changes its size
    std::optional<glm::dvec3> reach =
        {};              // m, from the middle, along its own axes: half a box's size, a radius
    bool round = false;  // all of `reach` are one radius
    std::optional<glm::dquat> turn = {};
};

// What the pointer can hold of a handle.
struct GizmoPart {
    enum class Kind { ring, arm, knob, circle } kind = Kind::ring;
    size_t handle = 0;
    int axis = 0;
    bool operator==(const GizmoPart&) const = default;
};

// ---- Arithmetic

// How far along a line the place is that is nearest to a ray; nothing: they are parallel. `axis`: unit.
std::optional<double> alongAxis(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& axis);
// The angle about an axis, rad, from where one ray meets the plane through `center` across the axis to where
// the other one does; nothing: one of them does not.
std::optional<double> angleAbout(const Ray& from, const Ray& to, const glm::dvec3& center,
                                 const glm::dvec3& axis);
// A handle after the pointer went from one ray to another and held a part of it. `ahead`: unit, of the view.
GizmoHandle dragged(const GizmoHandle& start, const GizmoPart& part, const Ray& from, const Ray& to,
                    const glm::dvec3& ahead);

class Gizmo {
  public:
    struct Change {
        size_t handle;
        GizmoHandle value;
    };
    // Draws them over the picture, below the panels, and returns what the pointer makes of one in this frame,
    // if it `may` change.
    std::optional<Change> draw(const std::vector<GizmoHandle>& handles, const View& view, bool may);
    bool holds() const { return held_.has_value(); }  // a part, for the pointer
    void release() { held_.reset(); }                 // the handles are others

  private:
    std::optional<GizmoPart> held_;
    GizmoHandle start_;  // as it was when the pointer took hold of it
    ImVec2 from_{};      // where that was
    size_t shown_ = 0;   // the handle that shows its axes
};

}  // namespace shoal::window
