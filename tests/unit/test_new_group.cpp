// What a new group of a molecule begins with.
#include "core/json_build.h"
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
