// Warnings of a plan: scenes that are valid and probably not what was meant.
#include <algorithm>

#include "compile/plan.h"
#include "core/error.h"
#include "molecule/gap.h"
#include "molecule/molecule_file.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// A sheet of 3 x 3 vertices 0.5 m apart: a ball of 0.354 m passes between three of them.
const std::string sheet = [] {
    std::string vertices, springs, triangles;
    for (int i = 0; i < 9; ++i)
        vertices += concat(i ? ", " : "", R"({"position": [)", 0.5 * (i % 3), ", 0, ", 0.5 * (i / 3), "]}");
    for (int i = 0; i < 8; ++i)
        springs += concat(i ? ", " : "", R"({"a": )", i, R"(, "b": )", i + 1, "}");
    for (const int a : {0, 1, 3, 4})
        triangles += concat(a ? ", " : "", "[", a, ", ", a + 3, ", ", a + 1, "], [", a + 1, ", ", a + 3, ", ",
                            a + 4, "]");
    return concat(R"({"format": "shoal-molecule-1", "name": "sheet",
        "defaults": {"mass": 0.1, "stiffness": 10}, "vertices": [)",
                  vertices, R"(], "springs": [)", springs, R"(], "triangles": [)", triangles, "]}");
}();

// All warnings of a scene with the keys given, one a line.
std::string warningsOf(const std::string& colliders, const std::string& group, const std::string& more = "") {
    const Scratch scratch;
    scratch.write("sheet.json", sheet);
    const std::string text = concat(R"({"format": "shoal-scene-1", )", more, R"("colliders": [)", colliders,
                                    R"(], "groups": [{)", group, "}]}");
    std::string out;
    for (const Warning& warning : compile(parseScene(text, scratch.path("s.json"))).warnings)
        out += warning.message + "\n";
    return out;
}

const std::string aSheet = R"("name": "sheet", "molecule": "sheet.json",
    "place": {"on": "list", "items": [{"position": [0, 2, 0]}]})";
const std::string balls = R"("name": "balls", "particle": {"mass": 1, "shape": "quads", "size": 0.5,
    "blend": "none"}, "place": {"on": "list", "items": [{"position": [0, 2, 0]}]})";
std::string swimmers(const std::string& molecule, const std::string& more = "") {
    return concat(R"("name": "fish", "molecule": ")", molecule, R"(", "school": {}, "count": 5,
        "place": {"on": "volume", "box": {"low": [0, 1, 0], "high": [1, 2, 1]}})",
                  more);
}

}  // namespace

TEST_CASE("what is thinner than the gaps between vertices is warned of", "[warnings]") {
    const auto ball = [](double radius) {
        return concat(R"({"type": "sphere", "name": "ball", "center": [0, 0, 0], "radius": )", radius, "}");
    };
    const std::string plane = R"({"type": "plane"})";
    CHECK_THAT(warningsOf(ball(0.3), aSheet),
               Contains("the sphere \"ball\" with a radius of 0.3 m passes through triangle 0") &&
                   Contains("\"radius\": 0.054"));
    CHECK_THAT(warningsOf(ball(0.36) + ", " + plane, aSheet), !Contains("alone touch"));
    CHECK_THAT(warningsOf(ball(0.3), aSheet + R"(, "contact": {"radius": 0.06})"), !Contains("alone touch"));
    const std::string middles = R"(, "contact": {"radius": 0.01, "triangles": true})";
    CHECK_THAT(warningsOf(ball(0.2), aSheet + middles), !Contains("alone touch"));
    CHECK_THAT(warningsOf(ball(0.19), aSheet + middles),
               Contains("its vertices and the spheres on its triangles alone touch colliders"));
    CHECK_THAT(warningsOf(ball(0.3), aSheet + R"(, "collide": false)"), !Contains("alone touch"));
    CHECK_THAT(
        warningsOf(R"({"type": "capsule", "from": [0, 0, 0], "to": [9, 0, 0], "radius": 0.1})", aSheet),
        Contains("the capsule with a radius of 0.1 m"));
    CHECK_THAT(warningsOf(R"({"type": "box", "center": [0, 0, 0], "size": [0.4, 0.4, 9]})", aSheet),
               Contains("the box with a radius of 0.28"));
    // instances of half the size have half the gap
    const std::string small =
        R"("molecule": "sheet.json", "place": {"on": "list", "items": [{"scale": 0.5}]})";
    CHECK_THAT(warningsOf(ball(0.3), small), !Contains("alone touch"));
}

TEST_CASE("points that are drawn larger than they touch are warned of", "[warnings]") {
    const std::string plane = R"({"type": "plane"})";
    CHECK_THAT(warningsOf(plane, balls), Contains("drawn 0.5 m wide") && Contains("\"radius\": 0.25"));
    CHECK_THAT(warningsOf(plane, balls + R"(, "contact": {})"), !Contains("drawn"));
    CHECK_THAT(warningsOf(R"({"type": "plane", "thickness": 0.25})", balls), !Contains("drawn"));
    CHECK_THAT(warningsOf("", balls), !Contains("drawn"));
}

TEST_CASE("molecules that start where positions are rounded are warned of", "[warnings]") {
    const auto at = [](const char* x) {
        return warningsOf(
            "", concat(R"("particle": {"mass": 1}, "place": {"on": "list", "items": [{"position": [)", x,
                       ", 0, 0]}, {}]}"));
    };
    CHECK_THAT(at("-1048577"), Contains("1 of 2 molecules") && Contains("1048576 m from the origin"));
    CHECK_THAT(at("-1048576"), !Contains("from the origin"));
}

TEST_CASE("a school that cannot swim is warned of", "[warnings]") {
    const std::string molecules = SHOAL_SOURCE_DIR "/molecules/";
    CHECK_THAT(warningsOf("", swimmers(molecules + "fry.json")), !Contains("swim"));
    CHECK_THAT(warningsOf("", swimmers(molecules + "fish.json")),
               Contains("no muscle") && !Contains("across its length"));
    CHECK_THAT(warningsOf("", swimmers(molecules + "leaf.json")),
               Contains("no muscle") && Contains("0.066 m long along Y"));
    CHECK_THAT(warningsOf("", swimmers(molecules + "point.json")), !Contains("swim"));
    const std::string water = R"("water": {"surface": 0.5}, )";
    CHECK_THAT(warningsOf("", swimmers(molecules + "fry.json"), water), Contains("5 of 5 molecules"));
    CHECK_THAT(warningsOf("", swimmers(molecules + "fry.json"), R"("water": {"surface": 2}, )"),
               !Contains("in the air"));
}

TEST_CASE("contact without a radius has one that closes the gaps", "[warnings]") {
    const auto radiusOf = [](const std::string& group) {
        const Scratch scratch;
        scratch.write("sheet.json", sheet);
        const Scene scene = parseScene(concat(R"({"format": "shoal-scene-1", "groups": [{)", group, "}]}"),
                                       scratch.path("s.json"));
        for (const Warning& warning : compile(scene).warnings)
            CHECK_THAT(warning.message, !Contains("gap"));
        return scene.groups[0].contact->radius;
    };
    CHECK(radiusOf(aSheet + R"(, "contact": {})") == Approx(std::sqrt(0.125) / 2));
    CHECK(radiusOf(aSheet + R"(, "contact": {"triangles": true})") < 0.9 * std::sqrt(0.125) / 2);
    CHECK(radiusOf(balls + R"(, "contact": {})") == 0.25);
    CHECK(radiusOf(aSheet + R"(, "contact": {"radius": 0.4})") == 0.4);
}
