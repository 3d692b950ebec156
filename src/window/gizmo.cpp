#include "window/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "window/interface.h"
#include "window/orbit_camera.h"

namespace shoal::window {

std::optional<double> alongAxis(const Ray& ray, const glm::dvec3& origin, const glm::dvec3& axis) {
    const double cosine = glm::dot(ray.along, axis), sine2 = 1 - cosine * cosine;
    if (sine2 < 1e-6) return {};
    const glm::dvec3 arm = ray.from - origin;
    return (glm::dot(arm, axis) - cosine * glm::dot(arm, ray.along)) / sine2;
}

std::optional<double> angleAbout(const Ray& from, const Ray& to, const glm::dvec3& center,
                                 const glm::dvec3& axis) {
    std::array<glm::dvec3, 2> arms{};
    for (int i = 0; i < 2; ++i) {
        const Ray& ray = i == 0 ? from : to;
        const double steep = glm::dot(ray.along, axis);
        const double distance = glm::dot(center - ray.from, axis) / steep;
        if (std::abs(steep) < 1e-3 || distance < 0) return {};
        arms[size_t(i)] = ray.from + distance * ray.along - center;
    }
    return std::atan2(glm::dot(axis, glm::cross(arms[0], arms[1])), glm::dot(arms[0], arms[1]));
}

// The axis of a part: arms go along the scene's axes, all else along the handle's own.
static glm::dvec3 axisOf(const GizmoHandle& handle, const GizmoPart& part) {
    glm::dvec3 axis(0);
    axis[part.axis] = 1;
    return handle.turn && part.kind != GizmoPart::Kind::arm ? *handle.turn * axis : axis;
}

GizmoHandle dragged(const GizmoHandle& start, const GizmoPart& part, const Ray& from, const Ray& to,
                    const glm::dvec3& ahead) {
    constexpr double smallest = 1e-3;  // m
    GizmoHandle out = start;
    const glm::dvec3 axis = axisOf(start, part);
    if (part.kind == GizmoPart::Kind::ring) {
        const double depth = glm::dot(start.position - from.from, ahead);
        out.position +=
            depth * (to.along / glm::dot(to.along, ahead) - from.along / glm::dot(from.along, ahead));
    } else if (part.kind == GizmoPart::Kind::circle) {
        const std::optional<double> angle = angleAbout(from, to, start.position, axis);
        if (angle) out.turn = glm::normalize(glm::angleAxis(*angle, axis) * *start.turn);
    } else {
        const std::optional<double> first = alongAxis(from, start.position, axis),
                                    last = alongAxis(to, start.position, axis);
        if (!first || !last) return out;
        if (part.kind == GizmoPart::Kind::arm) out.position += (*last - *first) * axis;
        if (part.kind == GizmoPart::Kind::arm) return out;
        double& reach = (*out.reach)[part.axis];
        reach = std::max(reach + *last - *first, smallest);
        if (start.round) out.reach = glm::dvec3(reach);
    }
    return out;
}

namespace {

struct Shape {
    GizmoPart part;
    std::vector<ImVec2> points;  // a line through them, or a knob
};

constexpr ImU32 colors[] = {IM_COL32(240, 90, 80, 255), IM_COL32(130, 210, 80, 255),
                            IM_COL32(90, 150, 255, 255)};

float distance(ImVec2 a, ImVec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

// From the pointer to what is drawn.
float distanceTo(const Shape& shape, ImVec2 pointer) {
    float nearest = distance(shape.points.front(), pointer);
    for (size_t i = 0; i + 1 < shape.points.size(); ++i) {
        const ImVec2 a = shape.points[i], b = shape.points[i + 1];
        const float length = std::max(distance(a, b), 1e-3f);
        const float along = ((pointer.x - a.x) * (b.x - a.x) + (pointer.y - a.y) * (b.y - a.y)) / length;
        const float share = std::clamp(along / length, 0.0f, 1.0f);
        nearest =
            std::min(nearest, distance({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}, pointer));
    }
    return nearest;
}

// The arms, knobs and circles of a handle. `point`: m, the size of a point of the interface there.
void addAxes(std::vector<Shape>& shapes, const GizmoHandle& handle, size_t index, const Projector& projector,
             double point) {
    using Kind = GizmoPart::Kind;
    const auto add = [&](Kind kind, int axis, const auto& places) {
        Shape shape{{kind, index, axis}, {}};
        for (const glm::dvec3& place : places)
            if (const std::optional<ImVec2> seen = projector.place(place)) shape.points.push_back(*seen);
        if (shape.points.size() == places.size()) shapes.push_back(std::move(shape));
    };
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 along = axisOf(handle, {Kind::arm, index, axis});
        const glm::dvec3 own = axisOf(handle, {Kind::knob, index, axis});
        if (handle.movable)
            add(Kind::arm, axis,
                std::vector{handle.position + 14 * point * along, handle.position + 64 * point * along});
        if (handle.reach) add(Kind::knob, axis, std::vector{handle.position + (*handle.reach)[axis] * own});
        if (!handle.turn) continue;
        std::vector<glm::dvec3> circle;
        const glm::dvec3 right = *handle.turn * glm::dvec3(axis == 1, axis == 2, axis == 0);
        for (int i = 0; i <= 48; ++i)
            circle.push_back(handle.position +
                             78 * point * (glm::angleAxis(i * 6.283185307179586 / 48, own) * right));
        add(Kind::circle, axis, circle);
    }
}

void drawShape(const Shape& shape, bool lit) {
    using Kind = GizmoPart::Kind;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const bool ring = shape.part.kind == Kind::ring;
    const ImU32 color = lit ? IM_COL32_WHITE : ring ? IM_COL32(255, 190, 70, 255) : colors[shape.part.axis];
    const ImVec2 first = shape.points.front(), last = shape.points.back();
    for (const bool shadow : {true, false}) {  // so that it shows on bright ground and on dark
        const ImU32 ink = shadow ? IM_COL32(0, 0, 0, 160) : color;
        const float width = points(shadow ? 4 : 2), knob = points(shadow ? 6 : 5);
        if (ring) list.AddCircle(first, points(9), ink, 32, width);
        if (shape.points.size() > 1)
            list.AddPolyline(shape.points.data(), int(shape.points.size()), ink, 0, width);
        if (shape.part.kind == Kind::arm) list.AddCircleFilled(last, knob, ink);
        if (shape.part.kind == Kind::knob)
            list.AddRectFilled({first.x - knob, first.y - knob}, {first.x + knob, first.y + knob}, ink);
    }
}

}  // namespace

std::optional<Gizmo::Change> Gizmo::draw(const std::vector<GizmoHandle>& handles, const View& view,
                                         bool may) {
    const ImGuiIO& io = ImGui::GetIO();
    const Projector projector(view, io.DisplaySize);
    if (held_ && (!ImGui::IsMouseDown(ImGuiMouseButton_Left) || held_->handle >= handles.size())) release();
    std::vector<Shape> shapes;
    for (size_t i = 0; i < handles.size(); ++i) {
        const std::optional<ImVec2> center = projector.place(handles[i].position);
        if (!center) continue;
        shapes.push_back({{GizmoPart::Kind::ring, i, 0}, {*center}});
        ImGui::GetBackgroundDrawList()->AddText(ImVec2(center->x + points(13), center->y + points(6)),
                                                IM_COL32(255, 255, 255, 230), handles[i].label.c_str());
        const glm::dvec3 beside = projector.onPlane({center->x + points(1), center->y}, handles[i].position);
        if (i == shown_ || handles.size() == 1)
            addAxes(shapes, handles[i], i, projector, glm::distance(beside, handles[i].position));
    }
    const Shape* nearest = nullptr;
    float nearness = 1;  // of how far the pointer may be off
    for (const Shape& shape : shapes) {
        const float share =
            distanceTo(shape, io.MousePos) / points(shape.part.kind == GizmoPart::Kind::ring ? 13 : 7);
        if (share < nearness) nearest = &shape, nearness = share;
    }
    if (nearest && !held_ && !io.WantCaptureMouse) {
        shown_ = nearest->part.handle;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
            held_ = nearest->part, start_ = handles[shown_], from_ = io.MousePos;
    }
    for (const Shape& shape : shapes)
        drawShape(shape, held_ ? shape.part == *held_ : &shape == nearest && !io.WantCaptureMouse);
    if (!may || !held_ || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return {};
    const auto ray = [&](ImVec2 place) {
        return Ray{view.eye, glm::normalize(projector.onPlane(place, view.target) - view.eye)};
    };
    return Change{held_->handle,
                  dragged(start_, *held_, ray(from_), ray(io.MousePos), -directionsOf(view)[2])};
}

}  // namespace shoal::window
