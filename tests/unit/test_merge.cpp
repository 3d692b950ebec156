// A file that changed on disk while edits of it are not saved: both are kept, or the conflict is said.
#include "core/description.h"
#include "core/json_edit.h"
#include "scene/json/scene_file.h"
#include "simulate/carry_over.h"
#include "support/catch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("JSON changed in two ways is put together value by value", "[merge]") {
    const auto parse = [](const char* text) { return parseJson(text, "test"); };
    const auto both = [&](const char* base, const char* mine, const char* theirs, const char* expected,
                          const std::vector<std::string>& conflicts, Prefer prefer = Prefer::mine) {
        std::vector<std::string> found;
        const JsonValue out = merged(parse(base), parse(mine), parse(theirs), prefer, "$", found);
        INFO(base << " " << mine << " " << theirs << " gave " << writeJsonLine(out));
        CHECK(sameJson(out, parse(expected)));
        CHECK(found == conflicts);
    };
    const char* base = R"({"a": 1, "b": [1, 2], "c": [{"x": 1}, {"x": 2}]})";
    both(base, R"({"a": 5, "b": [1, 2], "c": [{"x": 1}, {"x": 2}]})",
         R"({"a": 1, "b": [1, 2], "c": [{"x": 1}, {"x": 7}], "d": true})",
         R"({"a": 5, "b": [1, 2], "c": [{"x": 1}, {"x": 7}], "d": true})", {});
    both(R"({"a": 1})", R"({"a": 2})", R"({"a": 3})", R"({"a": 2})", {"$.a"});
    both(R"({"a": 1})", R"({"a": 2})", R"({"a": 3})", R"({"a": 3})", {"$.a"}, Prefer::theirs);
    both(R"({"a": 1})", R"({"a": 2})", R"({"a": 2})", R"({"a": 2})", {});
    // taken away by one, changed by the other; put in by both
    both(R"({"a": 1})", "{}", R"({"a": 3})", "{}", {"$.a"});
    both(R"({"a": 1})", "{}", R"({"a": 1})", "{}", {});
    both("{}", R"({"a": 2})", R"({"a": 3})", R"({"a": 3})", {"$.a"}, Prefer::theirs);
    // arrays of another length are one value
    both(R"({"c": [{"x": 1}]})", R"({"c": [{"x": 2}]})", R"({"c": []})", R"({"c": [{"x": 2}]})", {"$.c"});
    // but of named elements, which are found again wherever they stand
    const char* named = R"({"c": [{"name": "a", "x": 1}, {"name": "b", "x": 1}]})";
    both(named, R"({"c": [{"name": "a", "x": 2}, {"name": "b", "x": 1}]})",
         R"({"c": [{"name": "new"}, {"name": "b", "x": 3}, {"name": "a", "x": 1, "y": 4}]})",
         R"({"c": [{"name": "new"}, {"name": "b", "x": 3}, {"name": "a", "x": 2, "y": 4}]})", {});
    both(named, R"({"c": [{"name": "a", "x": 2}, {"name": "b", "x": 1}, {"name": "mine"}]})",
         R"({"c": [{"name": "b", "x": 1}]})",
         R"({"c": [{"name": "b", "x": 1}, {"name": "a", "x": 2}, {"name": "mine"}]})", {"$.c[\"a\"]"});
    both(named, R"({"c": [{"name": "a", "x": 2}, {"name": "b", "x": 1}]})",
         R"({"c": [{"name": "a", "x": 3}, {"name": "b", "x": 1}]})",
         R"({"c": [{"name": "a", "x": 3}, {"name": "b", "x": 1}]})", {"$.c[\"a\"].x"}, Prefer::theirs);
}

TEST_CASE("a school that is written reads back the same", "[merge]") {
    const Scratch scratch;
    const auto readBack = [&](const std::string& school) {
        const std::string place = R"("place": {"on": "list", "items": [{}]})";
        const std::string text = concat(
            R"({"format": "shoal-scene-1", "groups": [{"name": "fish", "molecule": "blade.json", )", place,
            R"(, "school": )", school, R"(}, {"name": "shark", "molecule": "blade.json", )", place, "}]}");
        return *parseScene(text, writeSmallScene(scratch, text)).groups[0].school;
    };
    const auto write = [](const School& school) { return describe(&school).write(school); };
    for (const char* text :
         {R"({})",
          R"({"radius": 0.1})",  // the separation radius is no larger
          R"({"radius": 0.7, "blind": 0.3, "separationRadius": 0.1, "separation": 3, "alignment": 1.5,
              "cohesion": 1, "slowest": 0.2, "cruise": 0.3, "fastest": 2, "acceleration": 5, "turn": 3, "steepest": 0.5,
              "reaction": 0.2, "bend": 0.9, "beat": 0.3, "fins": 0.5, "wander": 0.1, "depth": [-2, -1], "depthStrength": 2,
              "walls": 0.4, "look": 0.6, "home": {"center": [1, 2, 3], "radius": 4, "strength": 2},
              "flees": [{"group": "shark", "radius": 3, "strength": 5}]})",
          R"({"home": {"box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "hunts": [{"group": "shark"}]})"}) {
        const School school = readBack(text);
        const std::string written = writeJsonLine(write(school));
        INFO(written);
        CHECK(sameJson(write(readBack(written)), write(school)));
        CHECK(readBack(written).separationRadius == school.separationRadius);
    }
    CHECK(sameJson(write(readBack(R"({"radius": 0.7, "blind": 0.3, "look": 0.6})")),
                   parseJson(R"({"radius": 0.7, "blind": 0.3, "look": 0.6})", "test")));
}

TEST_CASE("groups of a changed file go on, those of another shape begin anew", "[merge]") {
    const Scratch scratch;
    const auto group = [](const char* name, const char* molecule, int count) {
        return concat(R"({"name": ")", name, R"(", "molecule": ")", molecule, R"(", "count": )", count,
                      R"(, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}})");
    };
    scratch.write("point.json",
                  R"({"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0], "mass": 1}],
  "springs": [], "triangles": []})");
    const auto plan = [&](const std::string& groups) {
        const std::string text = concat(R"({"format": "shoal-scene-1", "groups": [)", groups, "]}");
        return compile(parseScene(text, writeSmallScene(scratch, text)));
    };
    const Plan from = plan(group("a", "blade.json", 3) + ", " + group("b", "point.json", 2));
    SavedState saved{2.5, 150, {from.groups[0].start, from.groups[1].start}, 0.01, {}};
    for (GroupState& state : saved.groups)
        for (glm::vec3& velocity : state.velocities)
            velocity = glm::vec3(7);
    // "b" comes first now and has one more, "a" is made of something else, "c" is new
    const Plan to = plan(group("b", "point.json", 3) + ", " + group("a", "point.json", 3) + ", " +
                         group("c", "point.json", 1));
    const GoneOn gone = goOn(saved, from, to);
    CHECK(gone.restarted == std::vector<std::string>{"a", "c"});
    CHECK(gone.state.time == 2.5);
    CHECK(gone.state.frames == 150);
    CHECK(gone.state.step == 0);  // other masses
    CHECK(goOn(saved, from, from).state.step == 0.01);
    REQUIRE(gone.state.groups.size() == 3);
    CHECK(gone.state.groups[0].velocities ==
          std::vector<glm::vec3>{glm::vec3(7), glm::vec3(7), glm::vec3(0)});
    CHECK(gone.state.groups[0].anchors[1] == saved.groups[1].anchors[1]);
    CHECK(gone.state.groups[1] == to.groups[1].start);
    CHECK(gone.state.groups[2] == to.groups[2].start);
}
