// Colliders: the reference against closed forms; boxes and capsules: distance and normal as the GPU has them,
// against the definition and the reference.
#include <algorithm>
#include <cmath>
#include <random>

#include "compile/surface_pair.h"
#include "reference/colliders.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/message_of.h"
#include "support/shader_physics.h"
#include "support/small_scene.h"

namespace shoal {

using glm::dvec3;
using glm::vec3;
using glm::vec4;

namespace {

vec4 onGpu(const BoxCollider& box, const dvec3& x) {
    const vec4 turn{vec3(box.rotation.x, box.rotation.y, box.rotation.z), float(box.rotation.w)};
    const vec4 local =
        shader::boxSurface(shader::turnedBack(turn, vec3(x - box.center)), vec3(box.size / 2.0));
    return {shader::turned(turn, vec3(local.x, local.y, local.z)), local.w};
}

vec4 onGpu(const CapsuleCollider& capsule, const dvec3& x) {
    const dvec3 axis = capsule.to - capsule.from;
    const double squared = glm::dot(axis, axis);
    return shader::capsuleSurface(vec3(x - capsule.from), vec3(axis), squared > 0 ? float(1 / squared) : 0,
                                  {1, 0, 0}, float(capsule.radius));
}

void checkUnit(const vec4& surface) {
    CHECK(glm::length(vec3(surface.x, surface.y, surface.z)) == Approx(1).epsilon(1e-5));
    CHECK(std::isfinite(surface.w));
}

// The distance has slope 1 along its normal, and a step back by it ends on the surface.
template <typename Shape>
void checkSurface(const Shape& shape, const dvec3& x) {
    const vec4 gpu = onGpu(shape, x);
    const reference::Surface exact = reference::surfaceAt(shape, x);
    INFO("at " << x.x << " " << x.y << " " << x.z);
    checkUnit(gpu);
    CHECK(glm::length(exact.normal) == Approx(1).epsilon(1e-12));
    CHECK(double(gpu.w) == Approx(exact.distance).margin(2e-6));
    CHECK(std::abs(reference::surfaceAt(shape, x - exact.distance * exact.normal).distance) < 1e-12);
}

}  // namespace

TEST_CASE("every kind of collider is there, and as its closed form says", "[colliders][reference]") {
    std::vector<bool> there(std::variant_size_v<ColliderShape::variant>);
    for (const test::KindOfCollider& kind : test::kindsOfCollider()) {
        there[kind.shape.index()] = true;
        INFO(kindName(kind.shape));
        const reference::Surface found = reference::surfaceAt(kind.shape, kind.x);
        CHECK(glm::length(found.normal - kind.normal) < 1e-6);
        CHECK(found.distance == Approx(kind.distance).margin(1e-12));
        // the nearest point is the furthest along its normal where the shape is convex
        const std::optional<double> support = supportOf(kind.shape, kind.normal);
        if (support) CHECK(*support == Approx(glm::dot(kind.x, kind.normal) - kind.distance).margin(1e-12));
        const std::optional<double> reach = reachOf(kind.shape);
        if (reach) CHECK(glm::length(kind.x - found.distance * found.normal) <= *reach);
    }
    CHECK(std::find(there.begin(), there.end(), false) == there.end());
}

TEST_CASE("boxes: exact distance inside and outside", "[colliders][contact]") {
    const BoxCollider box{
        {0.3, -0.2, 1}, {0.4, 1.2, 2}, glm::angleAxis(0.7, glm::normalize(dvec3(1, 2, -1)))};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-1.5, 1.5);
    for (int i = 0; i < 2000; ++i)
        checkSurface(box, box.center + dvec3(at(random), at(random), at(random)));
    // against the nearest of many points of the surface
    for (int i = 0; i < 50; ++i) {
        const dvec3 local(at(random), at(random), at(random));
        double nearest = 1e9;
        for (int axis = 0; axis < 3; ++axis)
            for (int u = 0; u <= 40; ++u)
                for (int v = 0; v <= 40; ++v)
                    for (const double side : {-0.5, 0.5}) {
                        dvec3 p;
                        p[axis] = side, p[(axis + 1) % 3] = u / 40.0 - 0.5,
                        p[(axis + 2) % 3] = v / 40.0 - 0.5;
                        nearest = std::min(nearest, glm::length(p * box.size - local));
                    }
        const double distance = reference::surfaceAt(box, box.center + box.rotation * local).distance;
        CHECK(std::abs(distance) <= nearest + 1e-12);
        CHECK(std::abs(distance) >= nearest - 0.05);
    }
}

TEST_CASE("boxes and capsules: a unit normal everywhere", "[colliders][contact]") {
    const float sizes[] = {1e-20f, 1e-9f, 0.05f, 1.0f, 1e4f};
    for (const float a : sizes) {
        for (const float b : sizes) {
            const vec3 half(a, b, 1);
            for (int corner = 0; corner < 27; ++corner) {
                const vec3 sign(corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1);
                for (const float off : {0.0f, 1.0f, 1 - 1e-7f, 1 + 1e-7f})
                    checkUnit(shader::boxSurface(half * sign * off, half));
                checkUnit(shader::boxSurface(half * sign + sign * 1e-30f, half));
            }
        }
    }
    for (const vec3& axis : {vec3(0), vec3(2e-9f, 0, 0), vec3(0, 2, 0)}) {
        const float squared = glm::dot(axis, axis);
        for (const float t : {-1.0f, 0.0f, 0.5f, 1.0f, 2.0f}) {
            checkUnit(
                shader::capsuleSurface(axis * t, axis, squared > 1e-18f ? 1 / squared : 0, {1, 0, 0}, 0.1f));
        }
    }
    // half way between two faces, either is right
    const vec4 edge = shader::boxSurface({0.4f, 0.4f, 0}, {0.5f, 0.5f, 2});
    CHECK(edge.w == Approx(-0.1f));
}

TEST_CASE("capsules: exact distance, and a sphere where the ends coincide", "[colliders][contact]") {
    const CapsuleCollider capsule{{-0.5, 0.1, 0}, {0.7, 0.4, -0.6}, 0.3};
    const CapsuleCollider round{{0.2, 0.1, 0}, {0.2, 0.1, 0}, 0.3};
    const SphereCollider sphere{{0.2, 0.1, 0}, 0.3};
    std::mt19937 random(4);
    std::uniform_real_distribution<double> at(-1.5, 1.5);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 x(at(random), at(random), at(random));
        checkSurface(capsule, x);
        const vec4 gpu = onGpu(round, x);
        const reference::Surface same = reference::surfaceAt(sphere, x);
        CHECK(double(gpu.w) == Approx(same.distance).margin(1e-6));
        CHECK(glm::length(dvec3(gpu.x, gpu.y, gpu.z) - same.normal) < 1e-5);
    }
}

// ---- surfacePairs

namespace {

Scene pairScene(const std::string& pairs, const std::string& collider = "\"surface\": \"ice\"") {
    const test::Scratch scratch;
    scratch.write("blade.json", test::smallMolecule);
    const auto group = [](const std::string& keys) {
        return R"({"molecule": "blade.json", "count": 1, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, )" +
               keys + "}";
    };
    return readScene(scratch.write(
        "a.scene.json",
        R"({"format": "shoal-scene-1", "colliders": [{"type": "plane", "restitution": 0.3, "friction": 0.7, )" +
            collider + "}],\n\"groups\": [" +
            group(R"("surface": "leaf", "restitution": 0.1, "friction": 0.4)") + ", " +
            group(R"("restitution": 0.6, "friction": 0.9)") + "]" + pairs + "}"));
}

}  // namespace

TEST_CASE("surface pairs: a rule holds for both orders, else the collider's or the mix",
          "[colliders][scene]") {
    const Scene plain = pairScene("");
    CHECK(surfacePair(plain, plain.groups[0], plain.colliders[0]) == SurfacePair{0.3, 0.7});
    CHECK(surfacePair(plain, 0, 1).restitution == 0.6);
    CHECK(surfacePair(plain, 0, 1).friction == Approx(0.6));
    CHECK(surfacePair(plain, 0, 1) == surfacePair(plain, 1, 0));
    CHECK(surfacePair(plain, 0, 0) == SurfacePair{0.1, 0.4});
    const Scene ruled = pairScene(R"(, "surfacePairs": [{"between": ["ice", "leaf"], "friction": 0.02},
        {"between": ["leaf", "leaf"], "restitution": 0.9}])");
    CHECK(surfacePair(ruled, ruled.groups[0], ruled.colliders[0]) == SurfacePair{0.3, 0.02});
    CHECK(surfacePair(ruled, ruled.groups[1], ruled.colliders[0]) == SurfacePair{0.3, 0.7});
    CHECK(surfacePair(ruled, 0, 0) == SurfacePair{0.9, 0.4});
    CHECK(surfacePair(ruled, 0, 1).restitution == 0.6);
    CHECK(collidersOf(ruled, ruled.groups[0])[0].friction == 0.02);
}

TEST_CASE("surface pairs: what cannot be is refused", "[colliders][scene]") {
    const auto message = [](const std::string& pairs) {
        return messageOf([&] { pairScene(", \"surfacePairs\": [" + pairs + "]"); });
    };
    CHECK_THAT(
        message(R"({"between": ["leaff", "ice"], "friction": 0})"),
        Catch::Contains("no collider and no group has the surface \"leaff\" (did you mean \"leaf\"?)"));
    CHECK_THAT(message(R"({"between": ["leaf"], "friction": 0})"), Catch::Contains("two surfaces, found 1"));
    CHECK_THAT(message(R"({"between": ["leaf", "ice"]})"),
               Catch::Contains("\"restitution\" or a \"friction\""));
    CHECK_THAT(message(R"({"between": ["leaf", "ice"], "friction": -1})"), Catch::Contains("at least 0"));
    CHECK_THAT(
        message(
            R"({"between": ["leaf", "ice"], "friction": 0}, {"between": ["ice", "leaf"], "friction": 1})"),
        Catch::Contains("already have an entry"));
    CHECK_THAT(messageOf([] { pairScene("", "\"surface\": \"\""); }), Catch::Contains("empty string"));
}

TEST_CASE("boxes and capsules: bad input is refused where it stands", "[colliders][scene]") {
    const auto message = [](const std::string& shape) {
        return messageOf([&] {
            parseScene(R"({"format": "shoal-scene-1", "groups": [], "colliders": [)" + shape + "]}",
                       "a.json");
        });
    };
    CHECK_THAT(message(R"({"type": "box", "center": [0, 0, 0], "size": [1, 0, 1]})"),
               Catch::Contains("size[1]") && Catch::Contains("at least 1e-09"));
    CHECK_THAT(message(R"({"type": "box", "center": [0, 0, 0], "size": [1, 1, -2]})"),
               Catch::Contains("size[2]"));
    CHECK_THAT(message(R"({"type": "box", "center": [0, 0, NaN], "size": [1, 1, 1]})"),
               Catch::Contains("a.json:1:"));
    CHECK_THAT(message(R"({"type": "box", "size": [1, 1, 1]})"), Catch::Contains("center"));
    CHECK_THAT(message(R"({"type": "capsule", "from": [0, 0, 0], "to": [0, 1, 0], "radius": 0})"),
               Catch::Contains("radius") && Catch::Contains("at least 1e-09"));
    CHECK_THAT(message(R"({"type": "capsule", "from": [0, 0, 0], "radius": 1})"), Catch::Contains("to"));
}

}  // namespace shoal
