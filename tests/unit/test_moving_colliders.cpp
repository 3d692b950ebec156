// Paths of colliders: poses over time, what a frame gets of them, and what is refused.
#include <cmath>
#include <numbers>

#include "compile/generate.h"
#include "compile/plan.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/shapes.h"

namespace shoal {

using glm::dvec3;

namespace {

glm::dquat about(const dvec3& axis, double angle) {
    return glm::angleAxis(angle, glm::normalize(axis));
}

ColliderPath there(bool smooth) {
    ColliderPath path;
    path.keyframes = {{1, {{0, 0, 0}, {1, 0, 0, 0}}}, {3, {{4, 2, 0}, about({0, 0, 1}, 1)}}};
    path.smooth = smooth;
    return path;
}

}  // namespace

TEST_CASE("paths: straight or eased, held at both ends", "[colliders][path]") {
    for (const bool smooth : {false, true}) {
        const ColliderPath path = there(smooth);
        CHECK(poseAt(path, -7).position == dvec3(0));
        CHECK(poseAt(path, 9).position == dvec3(4, 2, 0));
        for (const double s : {0.0, 0.25, 0.5, 0.9}) {
            const Pose pose = poseAt(path, 1 + 2 * s);
            const double share = smooth ? s * s * (3 - 2 * s) : s;
            CHECK(glm::length(pose.position - share * dvec3(4, 2, 0)) < 1e-12);
            CHECK(std::abs(glm::dot(pose.rotation, about({0, 0, 1}, share))) == Approx(1).epsilon(1e-12));
        }
    }
    CHECK(there(true).fastestTurn() == Approx(0.75));
    CHECK(there(false).turns());
}

TEST_CASE("paths: repeat", "[colliders][path]") {
    ColliderPath path;
    path.repeats = true;
    path.keyframes = {{0.5, {}}, {1, {{1, 0, 0}, {1, 0, 0, 0}}}, {2.5, {}}};
    CHECK_FALSE(path.turns());
    for (const double time : {0.6, 0.9, 1.7, 2.4})
        for (const int round : {1, 2, 1000})
            CHECK(glm::length(poseAt(path, time + 2.0 * round).position - poseAt(path, time).position) <
                  1e-9);
    CHECK(poseAt(path, 0.1).position == dvec3(0));
}

TEST_CASE("paths: a frame's parameters hold its poses and velocities", "[colliders][path]") {
    const ColliderPath path = there(false);
    std::vector<glm::vec4> parameters(7);
    const double time = 1.5, frame = 1 / 60.0;
    setPoses(parameters, {{path, 0, true, true, 0.5}}, 6, time, frame);
    CHECK(glm::length(glm::vec3(parameters[1]) - glm::vec3(poseAt(path, time).position)) < 1e-6f);
    CHECK(glm::length(glm::vec3(parameters[2]) - glm::vec3(2, 1, 0)) < 1e-5f);
    CHECK(glm::length(glm::vec3(parameters[5]) - glm::vec3(0, 0, 0.5f)) < 1e-6f);
    CHECK(parameters[5].w == Approx(60));
    CHECK(parameters[6].x >= Approx(std::sqrt(5.0) + 0.25));
    // over the frame at those velocities the next pose is reached
    const Pose next = poseAt(path, time + frame);
    CHECK(glm::length(glm::vec3(parameters[1]) + glm::vec3(parameters[2]) * float(frame) -
                      glm::vec3(next.position)) < 1e-6f);
    CHECK(parameters[4].w == Approx(next.rotation.w));
    // velocities agree with small differences of the poses
    const Motion motion = motionBetween(poseAt(path, 2), poseAt(path, 2 + 1e-6), 1e-6);
    CHECK(glm::length(motion.velocity - dvec3(2, 1, 0)) < 1e-6);
    CHECK(glm::length(motion.spin - dvec3(0, 0, 0.5)) < 1e-6);
}

// A rotation and its negative are the same; between them a frame must not go the long way round.
TEST_CASE("paths: a frame turns by the short way whatever the signs of its quaternions",
          "[colliders][path]") {
    ColliderPath path;
    path.keyframes = {{0, {}}, {1, {{}, -about({0, 1, 0}, 1)}}, {2, {{}, about({0, 1, 0}, 2)}}};
    std::vector<glm::vec4> parameters(7);
    for (double time = 0; time < 2; time += 0.03) {
        setPoses(parameters, {{path, 0, true, true, 0.5}}, 6, time, 1 / 60.0);
        CAPTURE(time);
        CHECK(glm::dot(parameters[3], parameters[4]) > 0.999f);
        const dvec3 expected{0, time + 1 / 60.0 < 2 ? 1 : 0, 0};
        if (expected.y > 0) CHECK(glm::length(glm::vec3(parameters[5]) - glm::vec3(expected)) < 1e-5f);
    }
}

TEST_CASE("colliders: what stands still alone keeps its text, what moves changes no text with its numbers",
          "[colliders][path]") {
    std::vector<glm::vec4> samples;
    std::vector<Collider> one(1);
    const GeneratedColliders plain = generateColliders(one, samples);
    CHECK(plain.source.find("step/joint_contact.glsl") == std::string::npos);
    CHECK(plain.moving.empty());
    one[0].path = there(false);
    const GeneratedColliders moving = generateColliders(one, samples);
    CHECK(moving.source.find("const bool collidersMove = true") != std::string::npos);
    CHECK(moving.source.find("areSwept = false") != std::string::npos);  // a plane
    one[0].path->keyframes[1].pose.position.x = 7;
    CHECK(generateColliders(one, samples).source == moving.source);
}

TEST_CASE("colliders: any number of solids, in text that does not grow with them", "[colliders]") {
    const auto many = [](int count) {
        std::vector<Collider> out{Collider{}};
        for (int i = 0; i < count; ++i) {
            Collider one;
            one.shape = SphereCollider{{double(i), 0, 0}, 0.4};
            if (i % 3 == 1) one.shape = BoxCollider{{double(i), 0, 0}, {1, 1, 1}};
            if (i % 3 == 2) one.shape = CapsuleCollider{{double(i), 0, 0}, {double(i), 1, 0}, 0.2};
            out.push_back(one);
        }
        return out;
    };
    std::vector<glm::vec4> samples;
    const GeneratedColliders thousand = generateColliders(many(1000), samples);
    CHECK(thousand.parameters.size() < maxParameters);
    CHECK(samples.size() == 334 * 2 + 333 * 4 + 333 * 4 + 3 * 21);  // a ball for each 16
    CHECK(thousand.materials.size() == 1001);
    samples.clear();
    const GeneratedColliders more = generateColliders(many(3000), samples);
    CHECK(std::abs(int(more.source.size()) - int(thousand.source.size())) < 100);
    samples.clear();
    CHECK(generateColliders(many(12), samples).source.find("index = int(-0.5") == std::string::npos);
    CHECK(samples.empty());
}

TEST_CASE("paths: bad input is refused where it stands", "[colliders][path][badInput]") {
    const auto message = [](const std::string& path) {
        return messageOf([&] {
            parseScene(
                R"({"format": "shoal-scene-1", "groups": [], "colliders": [{"type": "plane", "path": )" +
                    path + "}]}",
                "a.json");
        });
    };
    CHECK_THAT(message(R"({"keyframes": [{"time": 0}]})"),
               Catch::Contains("at least two keyframes, found 1"));
    CHECK_THAT(message(R"({"keyframes": [{"time": 1}, {"time": 1}]})"),
               Catch::Contains("keyframes[1].time") && Catch::Contains("after that of the keyframe before"));
    CHECK_THAT(
        message(R"({"end": "repeat", "keyframes": [{"time": 0}, {"time": 1, "position": [1, 0, 0]}]})"),
        Catch::Contains("first again"));
    CHECK_THAT(message(R"({"end": "repaet", "keyframes": []})"), Catch::Contains("did you mean \"repeat\"?"));
    CHECK_THAT(message(R"({"keyframes": [{"time": 0, "rotation": [0, 0, 0, 0]}, {"time": 1}]})"),
               Catch::Contains("zero"));
    CHECK_THAT(message(R"({})"), Catch::Contains("keyframes"));

    Scene scene;
    Group group;
    group.molecule = test::point(1);
    group.count = 1;
    scene.groups.push_back(group);
    scene.colliders.resize(1);
    scene.colliders[0].name = "fan";
    scene.colliders[0].path = there(false);
    scene.colliders[0].path->keyframes[1] = {1.02, {{0, 0, 0}, about({0, 1, 0}, 3)}};
    CHECK_THAT(
        messageOf([&] { compile(scene); }),
        Catch::Contains("\"fan\" turns by 2.5 rad within a frame") && Catch::Contains("150 frames a second"));
}

}  // namespace shoal
