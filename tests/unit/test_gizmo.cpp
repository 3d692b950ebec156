// What a drag in the picture makes of a place, a size and a turn.
#include "support/catch.h"
#include "window/gizmo.h"

using namespace shoal;
using namespace shoal::window;

namespace {

constexpr double quarter = 1.5707963267948966;  // rad
const glm::dvec3 eye(0, 0, 10), ahead(0, 0, -1);

Ray towards(const glm::dvec3& place) {
    return {eye, glm::normalize(place - eye)};
}

double apart(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b);
}

}  // namespace

TEST_CASE("a ray meets an axis where they are nearest, and not where they are parallel", "[gizmo]") {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 0.5)), origin(0.3, -0.2, 0.1);
    for (const double along : {-2.0, 0.0, 1.5}) {
        const glm::dvec3 place = origin + along * axis;
        REQUIRE(alongAxis(towards(place), origin, axis));
        CHECK(*alongAxis(towards(place), origin, axis) == Approx(along).margin(1e-9));
        // a ray that passes it on the common perpendicular is nearest to the same place
        const glm::dvec3 beside = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
        const Ray passing{place + beside, glm::normalize(glm::cross(beside, axis) + 0.5 * axis)};
        CHECK(*alongAxis(passing, origin, axis) == Approx(along).margin(1e-9));
    }
    CHECK_FALSE(alongAxis({{1, 0, 0}, axis}, origin, axis));
}

TEST_CASE("an angle about an axis is that between the places in its plane", "[gizmo]") {
    const glm::dvec3 center(1, 2, 0), z(0, 0, 1);
    const Ray right = towards(center + glm::dvec3(1, 0, 0)), up = towards(center + glm::dvec3(0, 3, 0));
    CHECK(*angleAbout(right, up, center, z) == Approx(quarter));
    CHECK(*angleAbout(up, right, center, z) == Approx(-quarter));
    CHECK(*angleAbout(right, up, center, -z) == Approx(-quarter));
    CHECK_FALSE(angleAbout(right, {eye, {0, 1, 0}}, center, z));  // along the plane
    CHECK_FALSE(angleAbout(right, {eye, {0, 0, 1}}, center, z));  // away from it
}

TEST_CASE("a handle follows the pointer in the way of its part", "[gizmo]") {
    using Kind = GizmoPart::Kind;
    GizmoHandle start;
    start.position = {1, 0, 0};
    start.reach = glm::dvec3(1, 2, 3);
    start.turn = glm::angleAxis(quarter, glm::dvec3(0, 0, 1));
    const auto drag = [&](Kind kind, int axis, const glm::dvec3& from, const glm::dvec3& to) {
        return dragged(start, {kind, 0, axis}, towards(from), towards(to), ahead);
    };
    // across the view, at its depth, wherever on the ring the pointer took hold
    CHECK(apart(drag(Kind::ring, 0, {1.1, 0, 0}, {2.1, 1, 0}).position, {2, 1, 0}) < 1e-9);
    // along an axis of the scene alone
    CHECK(apart(drag(Kind::arm, 0, {1.5, 0, 0}, {2.5, 0, 0}).position, {2, 0, 0}) < 1e-9);
    CHECK(apart(drag(Kind::arm, 1, {1, 0.5, 0}, {1, 2, 0}).position, {1, 1.5, 0}) < 1e-9);
    // its own x points up: a radius stays one, and nothing gets smaller than nothing
    CHECK(apart(*drag(Kind::knob, 0, {1, 1, 0}, {1, 1.5, 0}).reach, {1.5, 2, 3}) < 1e-9);
    CHECK((*drag(Kind::knob, 0, {1, 1, 0}, {1, -7, 0}).reach).x == Approx(1e-3));
    const GizmoHandle turned = drag(Kind::circle, 2, {2, 0, 0}, {1, 1, 0});
    CHECK(apart(*turned.turn * glm::dvec3(1, 0, 0), {-1, 0, 0}) < 1e-9);
    CHECK(apart(turned.position, start.position) == 0);
    start.round = true;
    CHECK(apart(*drag(Kind::knob, 0, {1, 1, 0}, {1, 1.5, 0}).reach, {1.5, 1.5, 1.5}) < 1e-9);
}
