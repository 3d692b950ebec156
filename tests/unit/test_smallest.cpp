// Parts that the window adds to a scene: of each kind the least that a file may say.
#include <set>

#include "core/json_build.h"
#include "core/smallest.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;

namespace {

std::string textOf(const Key& key) {
    return key.name == "molecule" ? SHOAL_SOURCE_DIR "/molecules/quad.json" : key.name;
}

// "" or what is wrong with a scene of a molecule and one more element.
std::string problemWith(const std::string& list, const JsonValue& element) {
    const JsonValue place = object(
        key("on", "volume"), key("box", object(key("low", glm::dvec3(-1)), key("high", glm::dvec3(1)))));
    const JsonValue group = object(key("molecule", SHOAL_SOURCE_DIR "/molecules/quad.json"), key("count", 3),
                                   key("place", place));
    JsonValue scene = object(key("format", "shoal-scene-1"), key("groups", std::vector<JsonValue>{group}));
    scene.add(list, toJson(std::vector<JsonValue>{element}));
    return messageOf([&] { parseScene(writeJson(scene), "a.scene.json"); });
}

}  // namespace

TEST_CASE("the least of each kind is a scene, but for what rules between keys and files ask for", "[json]") {
    const Description& scene = describe(static_cast<const Scene*>(nullptr));
    std::set<std::string> incomplete;
    int read = 0;
    for (const Key& list : scene.keys()) {
        if (list.kind != Key::Kind::list || list.name == "groups") continue;
        const Description& element = *list.objects[0];
        std::vector<const Description*> kinds;
        if (const Key* key = variantOf(element)) kinds = key->objects;
        if (kinds.empty()) kinds = {&element};
        for (const Description* kind : kinds) {
            const JsonValue one =
                kind == &element ? smallestObject(element, textOf) : smallestObject(element, *kind, textOf);
            const std::string problem = problemWith(list.name, one);
            INFO(list.name << ", " << kind->name() << ": " << problem << "\n" << writeJson(one));
            if (!problem.empty()) incomplete.insert(kind->name());
            CHECK_THAT(problem,
                       !Catch::Contains("unknown") && !Catch::Contains("found a"));  // but incomplete
            read += problem.empty();
        }
    }
    CHECK(read >= 15);
    CHECK((incomplete == std::set<std::string>{"attract", "distanceField", "grid", "heightField", "model",
                                               "surfacePair", "thrust", "waves"}));
}

TEST_CASE("a key means something beside what an object says or leaves out", "[json]") {
    const Description& group = describe(static_cast<const Group*>(nullptr));
    const Key& release = *group.find("release");
    CHECK(meansSomething(group, release, object()));
    CHECK(!meansSomething(group, release, object(key("held", false))));
}
