// Mistakes of users: each is one Error that says where it is and what was expected.
#include <algorithm>
#include <functional>

#include "core/image.h"
#include "molecule/molecule_file.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

std::string failure(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "(no error)";
}

// The small scene with one piece of its text exchanged. A "^" in what is put in says where the error must be;
// it is not part of the text.
class Wrong {
  public:
    Wrong() { writeSmallScene(scratch_); }

    std::string scene(const std::string& from, const std::string& to) const {
        return message("s.json", smallScene, from, to,
                       [&](const std::string& text) { parseScene(text, scratch_.path("s.json")); });
    }
    std::string molecule(const std::string& from, const std::string& to) const {
        return message("m.json", smallMolecule, from, to,
                       [](const std::string& text) { parseMolecule(text, "m.json"); });
    }
    const Scratch& scratch() const { return scratch_; }

  private:
    static std::string message(const std::string& file, std::string text, const std::string& from,
                               const std::string& to, const std::function<void(const std::string&)>& parse) {
        const size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        text.replace(at, from.size(), to);
        const size_t mark = to.find('^');
        if (mark == std::string::npos) return failure([&] { parse(text); });
        text.erase(at + mark, 1);
        const size_t line = size_t(std::count(text.begin(), text.begin() + ptrdiff_t(at + mark), '\n'));
        const size_t column = at + mark - (line == 0 ? 0 : text.rfind('\n', at + mark - 1) + 1);
        const std::string out = failure([&] { parse(text); });
        CHECK_THAT(out, Contains(concat(file, ":", line + 1, ":", column + 1, ": ")));
        return out;
    }

    Scratch scratch_;
};

}  // namespace

TEST_CASE("bad input: files that a scene names", "[badInput]") {
    const Wrong wrong;
    CHECK_THAT(failure([] { readScene("nowhere/x.scene.json"); }),
               Contains("nowhere/x.scene.json: no such file"));
    const std::string missing = wrong.scene("\"blade.json\"", "^\"../laef.json\"");
    CHECK_THAT(missing, Contains("no such file: ") && Contains("laef.json (at $.groups[0].molecule)"));
    CHECK_THAT(wrong.scene("\"blade.json\"", "^\"laef\""),
               Contains("no molecule that ships is called \"laef\" "
                        "(did you mean \"leaf\"?)"));
    CHECK_THAT(wrong.scene("\"blade.json\"", "^\"blade\""),
               Contains("(expected one of ") && Contains("leaf, ") && Contains("fish, "));
    CHECK_THAT(wrong.scene("\"hill.obj\"", "^\"hall.obj\""),
               Contains("no such file: ") && Contains("hall.obj"));
    CHECK_THAT(wrong.scene("wind.fga", "wand.fga"),
               Contains("no such file: ") && Contains("$.fields[7].file"));
    CHECK_THAT(wrong.scene("wind.fga", "hill.obj"), Contains("expected a vector field as .fga"));
    CHECK_THAT(wrong.scene("\"blade.json\"", "\"\""), Contains("expected the name of a file"));
    CHECK_THAT(wrong.scene("\"blade.json\"", "\".\""), Contains("found a folder"));

    // A mistake inside such a file is reported there.
    wrong.scratch().write("bad.json", "{\n  \"format\": 3\n}");
    CHECK_THAT(wrong.scene("\"blade.json\"", "\"bad.json\""), Contains("bad.json:2:13: expected"));
    wrong.scratch().write("bad.fga", "1,1,1,\n0,0,0,\n1,x,1");
    CHECK_THAT(wrong.scene("wind.fga", "bad.fga"), Contains("bad.fga:3:3: expected a number, found \"x\""));
    wrong.scratch().write("bad.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
    CHECK_THAT(wrong.scene("hill.obj", "bad.obj"), Contains("\"hill\" has no triangles, expected"));
}

TEST_CASE("bad input: waves and hurricanes", "[badInput]") {
    const Wrong wrong;
    CHECK_THAT(wrong.scene("\"direction\": [1, 0, 1], \"phase\"", "\"direction\": [0, 1, 0], \"phase\""),
               Contains("waves travel level (at $.fields[9].trains[0].direction)"));
    CHECK_THAT(wrong.scene("\"amplitude\": 0.1", "\"amplitude\": 0.7"),
               Contains("would curl over, found 0.7"));
    CHECK_THAT(wrong.scene("\"depth\": 3", "\"depth\": 0.05"),
               Contains("less than the depth of 0.05 m, found 0.1"));
    CHECK_THAT(wrong.scene("\"amplitude\": 0.1, ", ""), Contains("$.fields[9].trains[0]"));
    CHECK_THAT(wrong.scene("\"gravity\": 9,", "\"gravity\": 0,"), Contains("$.fields[9].gravity"));
    CHECK_THAT(wrong.scene("\"radius\": 4, \"shape\"", "\"radius\": 0, \"shape\""),
               Contains("$.fields[10].radius"));
    CHECK_THAT(wrong.scene("\"inflow\": 0.3", "\"inflow\": 1.6"), Contains("$.fields[10].inflow"));
    CHECK_THAT(wrong.scene("\"shape\": 1.2", "\"shape\": 9"), Contains("$.fields[10].shape"));
}

TEST_CASE("bad input: scenes that are not scenes", "[badInput]") {
    const Wrong wrong;
    const auto whole = [](const std::string& text) { return failure([&] { parseScene(text, "s.json"); }); };
    CHECK_THAT(whole(""), Contains("s.json:1:1: "));
    CHECK_THAT(whole("hello"), Contains("s.json:1:1: "));
    CHECK_THAT(whole("[]"), Contains("s.json:1:1: expected an object, found an array"));
    CHECK_THAT(whole("{\n}"), Contains("s.json:1:1: ") && Contains("\"format\""));
    CHECK_THAT(whole("{\"format\": \"shoal-scene-2\"}"),
               Contains("s.json:1:12: ") && Contains("shoal-scene-1"));
    CHECK_THAT(whole("{\"format\": \"shoal-scene-1\"}"), Contains("\"groups\""));
    CHECK_THAT(whole("{\"format\": \"shoal-scene-1\",\n\"groups\": []}"),
               Contains("s.json:2:11: expected at least one group"));
    CHECK_THAT(wrong.scene("\"camera\"", "\"camera\" ^5"), Contains("expected"));
    CHECK_THAT(wrong.scene("\"gravity\"", "\"gravty\""),
               Contains("gravty") && Contains("did you mean \"gravity\"?"));
    CHECK_THAT(wrong.scene("\"count\"", "\"cuont\""), Contains("did you mean \"count\"?"));
    CHECK_THAT(wrong.scene("\"substeps\"", "^\"subSteps\""), Contains("\"substeps\""));
    CHECK_THAT(wrong.scene("\"seed\"", "^\"name\""), Contains("twice"));
}

TEST_CASE("bad input: values of a scene", "[badInput]") {
    const Wrong wrong;
    struct Case {
        const char *from, *to, *first, *second;
    };
    const Case cases[] = {
        {"[0, -9.81, 0]", "[0, ^NaN, 0]", "", ""},
        {"[0, -9.81, 0]", "[0, ^1e999, 0]", "", ""},
        {"[0, -9.81, 0]", "[0, ^1e300, 0]", "expected a number within 1e+15 of 0", "$.gravity[1]"},
        {"[0, -9.81, 0]", "^[0, -9.81]", "expected", "3"},
        {"[0, -9.81, 0]", "^-9.81", "expected an array of 3 numbers, found a number", ""},
        {"\"frameRate\": 30", "\"frameRate\": ^0", "expected a number from 1 to 100000", "found 0"},
        {"\"substeps\": 12", "\"substeps\": ^1.5", "expected", "whole"},
        {"\"euler\"", "^\"eular\"", "", "did you mean \"euler\"?"},
        {"\"vortex\"", "\"vortx\"", "did you mean \"vortex\"?", "$.fields[3].type"},
        {"\"radius\": 0.5, \"lift\"", "\"radius\": 0, \"lift\"", "expected a number", "$.fields[3].radius"},
        {"\"high\": [1, 2, 3]}", "\"high\": [1, 2, -3]}", "expected high above low", "along z"},
        {"[[1, 2, 3], [4, 5, 6], [7, 8, 9]]", "[[1, 2, 3], [4, 5, 6]]", "three rows of three numbers", ""},
        {"\"direction\": [0, 0, 4]", "\"direction\": [0, 0, 0]", "expected a direction", "found zero"},
        {"\"octaves\": 4", "\"octaves\": 5", "from 1 to 4", "found 5"},
        {"\"frequency\": 1.5, ", "", "missing", "$.fields[8]"},
        {"\"frequency\": 1.5", "\"frequency\": -1", "expected a number", "$.fields[8].frequency"},
        {"\"seed\": 5", "\"seed\": 4294967296", "at most 4294967295", "$.fields[1].seed"},
        {"\"restitution\": 0.9", "\"restitution\": 1.1", "from 0 to 1", "$.colliders[0].restitution"},
        {"\"model\": \"hill\", \"resolution\"", "\"model\": \"hall\", \"resolution\"",
         "no model is named \"hall\"", "did you mean \"hill\"?"},
        {"\"model\": \"hill\", \"resolution\": 5, ", "", "either \"image\" or \"model\"", ""},
        {"\"resolution\": 5", "\"resolution\": 1", "from 2 to 4096", ""},
        {"\"count\": 3", "\"count\": ^0", "expected a whole number from 1 to 1073741824, found 0", ""},
        {"\"count\": 3", "\"count\": -3", "expected a whole number from 1 to 1073741824, found -3",
         "$.groups[0].count"},
        {"\"count\": 3", "\"count\": 1073741825", "from 1 to 1073741824", "found 1073741825"},
        {"\"count\": 3", "\"count\": 1e300", "from 1 to 1073741824", ""},
        {"\"count\": 3", "\"count\": \"3\"", "expected a number, found a string", ""},
        {"\"count\": 3,", "", "\"count\"", "$.groups[0]"},
        {"\"place\": {\"on\": \"grid\"", "\"count\": 25, \"place\": {\"on\": \"grid\"",
         "at most 24, the number of places", ""},
        {"[2, 3, 4]", "[4096, 4096, 4096]", "at most 1073741824", ""},
        {"[2, 3, 4]", "[2, 3]", "three whole numbers, found 2", ""},
        {"\"model\": \"hill\", \"select\"", "\"model\": \"hil\", \"select\"", "did you mean \"hill\"?",
         "$.groups[0].place.model"},
        {"\"object\": \"post\"", "\"object\": \"pst\"", "has no object \"pst\"", "did you mean \"post\"?"},
        {"\"minHeight\": 2.5", "\"minHeight\": 2.5, \"maxHeight\": 1", "maxHeight of at least minHeight", ""},
        {"\"droop\": 0.5", "\"droop\": 2", "from 0 to 1", "found 2"},
        {"\"scale\": [0.5, 2]", "\"scale\": [2, 0.5]", "expected [least, most]", ""},
        {"\"scale\": [0.5, 2]", "\"scale\": 0", "expected a number", "found 0"},
        {"\"turn\": \"any\"", "\"align\": \"normal\"", "needs a model to sit on", "$.groups[2].place.align"},
        {"\"force\": 0.5, \"rate\": 0.25, ", "", "a \"force\" or a \"rate\"", "$.groups[0].release"},
        {"\"held\": false", "\"held\": false, \"release\": {\"rate\": 1}", "\"release\" needs \"held\": true",
         ""},
        {"\"tangent\": 1}", "\"tangnt\": 1}", "\"tangent\"", "$.groups[0].drag"},
        {"[2, 3, 4]", "[2, 3, 4], \"box\": [1]", "\"box\" needs \"on\": \"volume\"", ""},
        {"[0, 0, 2, 2]", "[0, 0, 0, 0]", "expected a quaternion", "found zero"},
        {"[0, 0, 2, 2]", "[0, 0, 2]", "expected a quaternion [x, y, z, w], found 3 numbers", ""},
        {"\"target\": [0, 0, 0]", "\"target\": [1, 2, 3]", "", "eye and target apart"},
        {"{\"type\": \"abc\"", "{\"name\": \"wind\", \"type\": \"abc\"", "the name \"wind\" is already taken",
         ""},
    };
    for (const Case& c : cases) {
        INFO(c.from << " -> " << c.to);
        const std::string message = wrong.scene(c.from, c.to);
        CHECK_THAT(message, Contains("s.json:") && Contains(c.first) && Contains(c.second));
    }
}

TEST_CASE("bad input: molecules", "[badInput]") {
    const Wrong wrong;
    CHECK_THAT(wrong.molecule("\"b\": 1", "\"b\": ^7"), Contains("7"));
    CHECK_THAT(wrong.molecule("[[0, 1, 2]]", "[[0, 1, ^-2]]"), Contains("-2"));
    CHECK_THAT(wrong.molecule("\"mass\": 0.01", "\"mass\": ^0"), Contains("from 1e-12"));
    CHECK_THAT(wrong.molecule("\"restLength\"", "\"restLenght\""), Contains("did you mean \"restLength\"?"));
    CHECK_THAT(wrong.molecule("0.05]", "^nan]"), Contains("expected"));
}

TEST_CASE("bad input: images", "[badInput]") {
    const Wrong wrong;
    const Scratch& scratch = wrong.scratch();
    const std::string from = "\"model\": \"hill\", \"resolution\": 5";
    const auto image = [&](const std::string& name, const std::string& more = "") {
        return wrong.scene(from, "\"image\": \"" + name +
                                     "\", \"low\": [0, 0], \"high\": [1, 1], \"heights\": [0, 1]" + more);
    };
    scratch.write("text.png", "this is no picture");
    CHECK_THAT(image("text.png"), Contains("text.png: ") && Contains("PNG"));
    CHECK_THAT(image("none.png"), Contains("no such file"));
    writePng(scratch.path("dot.png"), Image{1, 1, 1, {0}});
    CHECK_THAT(image("dot.png"),
               Contains("dot.png: expected an image of at least 2 by 2 pixels, found 1 by 1"));
    const std::vector<uint8_t> grey = {0, 255, 128, 64};
    writePng(scratch.path("good.png"), Image{2, 2, 1, grey});
    CHECK(image("good.png") == "(no error)");
    CHECK_THAT(image("good.png", ", \"model\": \"hill\""), Contains("either \"image\" or \"model\""));
    const std::string bytes = readFile(scratch.path("good.png"));
    scratch.write("short.png", bytes.substr(0, bytes.size() / 2));
    CHECK_THAT(image("short.png"), Contains("short.png: "));
}
