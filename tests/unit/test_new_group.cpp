// What a new group of a molecule begins with.
#include "core/json_build.h"
#include "core/smallest.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "scene/known_colliders.h"
#include "support/catch.h"
#include "window/new_elements.h"

using namespace shoal;
using namespace shoal::window;

TEST_CASE("a new group of each molecule that ships is read, and lies above the ground", "[new-group]") {
    Scene scene;
    scene.file = std::string(SHOAL_SOURCE_DIR) + "/models/hello/new.scene.json";
    scene.colliders = {Collider{"floor", "", PlaneCollider{{0, 2, 0}}}};
    JsonValue groups = JsonValue::makeArray();
    for (const std::string& file : moleculesFor(scene.file))
        groups.items.push_back(groupOf(groups, file, scene));
    REQUIRE(groups.items.size() > 10);
    const Scene made = parseScene(
        writeJsonLine(object(key("format", "shoal-scene-1"), key("name", "all"), key("groups", groups))),
        scene.file);
    for (const Group& group : made.groups) {
        INFO(group.name);
        CHECK(group.count == 100);
        CHECK(group.place.box.low.y > 2);
        CHECK(group.place.box.high.x - group.place.box.low.x > 0.1);
    }
    const auto dragOf = [&](const std::string& name) {
        for (const Group& group : made.groups)
            if (group.name == name) return group.drag.normal;
        return -1.0;
    };
    CHECK(dragOf("leaf") == 9);
    CHECK(dragOf("fry") == 40);
    CHECK(dragOf("snow") == 3);
}

TEST_CASE("a new collider stands on the ground below what the camera looks at", "[new-group]") {
    Scene scene;
    scene.camera.target = {3, 1, -2};
    scene.colliders = {Collider{"floor", "", PlaneCollider{{0, 2, 0}}}};
    const TextOf none = [](const Key&) { return std::string(); };
    const auto made = [&](const Description& kind) {
        JsonValue out = smallestObject(describe(&scene.colliders[0]), kind, none);
        standInView(out, scene);
        return out;
    };
    const JsonValue ball = made(describe(static_cast<const SphereCollider*>(nullptr)));
    const double radius = ball.find("radius")->number;
    CHECK(numbersOf(*ball.find("center")) == std::vector<double>{3, 2 + radius, -2});
    const JsonValue box = made(describe(static_cast<const BoxCollider*>(nullptr)));
    CHECK(numbersOf(*box.find("center")) ==
          std::vector<double>{3, 2 + numbersOf(*box.find("size"))[1] / 2, -2});
    const JsonValue capsule = made(describe(static_cast<const CapsuleCollider*>(nullptr)));
    CHECK(numbersOf(*capsule.find("from"))[1] == 2 + capsule.find("radius")->number);
    CHECK(numbersOf(*capsule.find("to"))[1] > numbersOf(*capsule.find("from"))[1]);
}
