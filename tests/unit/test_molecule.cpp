#include "support/catch.h"

#include <filesystem>
#include <set>

#include "core/file.h"
#include "core/json.h"
#include "core/random.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "support/message_of.h"

using namespace shoal;

static const char* head = R"({"format": "shoal-molecule-1", "defaults": {"mass": 1, "stiffness": 10}, )";
static const char* square =
    R"("vertices": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [1, 1, 0]}, {"position": [0, 1, 0]}])";

static std::string withSprings(const std::string& springs) {
    return concat(head, square, ", \"springs\": [", springs, "]}");
}
static std::string withTriangles(const std::string& triangles) {
    return concat(head, square, ", \"triangles\": [", triangles, "]}");
}
static std::string withVertex(const std::string& vertex) {
    return concat(head, "\"vertices\": [", vertex, "]}");
}
static std::string refusal(const std::string& text) {
    return messageOf([&] { parseMolecule(text, "f"); });
}
static bool mentions(const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.starts_with("f:1:"));
    return text.find(part) != std::string::npos;
}

static std::vector<std::string> shippedFiles() {
    std::vector<std::string> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(SHOAL_SOURCE_DIR) + "/molecules"))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            files.push_back(entry.path().string());
    return files;
}

TEST_CASE("a molecule file fills every field", "[molecule]") {
    const Molecule m = parseMolecule(R"({"format": "shoal-molecule-1", "name": "pair", "comment": "why",
        "vertices": [{"position": [1, 2, 3], "uv": [0.25, 0.5], "mass": 0.5, "pinned": true, "comment": "here"},
                     {"position": [1, 2, 4], "mass": 2}, {"position": [1, 3, 4], "mass": 2}],
        "springs": [{"a": 0, "b": 1, "stiffness": 7, "damping": 0.1, "restLength": 0.9,
                     "actuation": {"amplitude": 0.2, "frequency": 3, "phase": 1}},
                    {"a": 1, "b": 2, "stiffness": 8}],
        "triangles": [[0, 1, 2]],
        "material": {"color": [0.1, 0.2, 0.3], "secondColor": [1, 1, 0], "texture": "t.png", "alphaCut": 0.4,
                     "metallic": 0.6, "translucency": 0.6, "roughness": 0.2, "pointSize": 0.1}})",
                                     "f");
    CHECK((m.name == "pair" && m.comment == "why" && m.file == "f"));
    CHECK((m.vertices[0].position == glm::dvec3(1, 2, 3) && m.vertices[0].uv == glm::dvec2(0.25, 0.5)));
    CHECK((m.vertices[0].mass == 0.5 && m.vertices[0].pinned && !m.vertices[1].pinned && m.hasPins()));
    CHECK((m.springs[0].stiffness == 7 && m.springs[0].damping == 0.1 && m.restLength(m.springs[0]) == 0.9));
    CHECK((m.springs[0].actuation->amplitude == 0.2 && m.springs[0].actuation->frequency == 3));
    CHECK((m.springs[1].damping == 0 && m.restLength(m.springs[1]) == 1 && !m.springs[1].actuation));
    CHECK((m.triangles[0].b == 1 && m.triangles[0].c == 2));
    CHECK((m.material.secondColor == glm::dvec3(1, 1, 0) && m.material.texture == "t.png"));
    CHECK((m.material.alphaCut == 0.4 && m.material.translucency == 0.6 && m.material.pointSize == 0.1));
    CHECK(m.material.metallic == 0.6);
    CHECK(m.places.vertices[1].line == 3);
    CHECK(m.places.springs[1].path == "$.springs[1]");
    CHECK(m.size() == Approx(std::sqrt(2.0)));
}

TEST_CASE("what has no meaning is refused with its place", "[molecule]") {
    CHECK(mentions(refusal("{}"), "missing key \"format\""));
    CHECK(mentions(refusal("[]"), "expected an object, found an array"));
    CHECK(mentions(refusal(R"({"format": "shoal-molecule-2"})"), "expected the format \"shoal-molecule-1\""));
    CHECK(mentions(refusal(R"({"format": "shoal-molecule-2"})"), "newer version"));
    CHECK_FALSE(mentions(refusal(R"({"format": "shoal-scene-1"})"), "newer version"));
    CHECK(mentions(refusal(concat(head, "\"vertices\": []}")), "expected at least one vertex"));
    CHECK(mentions(refusal(concat(head, "\"name\": \"x\"}")), "missing key \"vertices\""));
    CHECK(mentions(refusal(withVertex("{}")), "missing key \"position\" (at $.vertices[0])"));
    CHECK(
        mentions(refusal(withVertex(R"({"position": [0, 0]})")), "expected an array of 3 numbers, found 2"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 1e999]})")), "a number that fits a double"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 1e30]})")), "from -1e+06 to 1e+06, found 1e30"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, NaN, 0]})")), "found NaN"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 0], "mass": 0})")),
                   "from 1e-12 to 1e+12, found 0"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 0], "mass": -1})")),
                   "from 1e-12 to 1e+12, found -1"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 0], "mass": 1e-300})")), "a number from 1e-12"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 0], "masss": 1})")), "did you mean \"mass\"?"));
    CHECK(mentions(refusal(withVertex(R"({"position": [0, 0, 0], "pinned": 1})")), "expected true or false"));
    CHECK(mentions(refusal(R"({"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0]}]})"),
                   "missing key \"mass\" (give it here or in \"defaults\")"));
    CHECK(mentions(refusal(concat(head, square, ", \"material\": {\"color\": [2, 0, 0]}}")),
                   "from 0 to 1, found 2"));
    CHECK(mentions(refusal(concat(head, square, ", \"material\": {\"pointSize\": 0}}")), "a number above 0"));
}

TEST_CASE("springs that cannot be are refused", "[molecule]") {
    CHECK(refusal(withSprings(R"({"a": 0, "b": 1})")).empty());
    CHECK(mentions(refusal(withSprings(R"({"a": 0, "b": 9})")),
                   "vertex index 9 is out of range: the molecule has 4 vertices (at $.springs[0].b)"));
    CHECK(mentions(refusal(withSprings(R"({"a": -1, "b": 1})")), "vertex index -1 is out of range"));
    CHECK(mentions(refusal(withSprings(R"({"a": 0.5, "b": 1})")), "a whole number, found 0.5"));
    CHECK(mentions(refusal(withSprings(R"({"a": 2, "b": 2})")), "two different vertices, found 2 twice"));
    CHECK(mentions(refusal(withSprings(R"({"a": 0, "b": 1}, {"a": 1, "b": 0})")), "exists already"));
    CHECK(
        mentions(refusal(withSprings(R"({"a": 0, "b": 1, "stiffness": -1})")), "from 0 to 1e+15, found -1"));
    CHECK(mentions(refusal(withSprings(R"({"a": 0, "b": 1, "damping": -1})")), "from 0 to 1e+15, found -1"));
    CHECK(mentions(refusal(withSprings(R"({"a": 0, "b": 1, "restLength": 0})")),
                   "from 1e-09 to 1e+06, found 0"));
    CHECK(mentions(refusal(withSprings(R"({"a": 0, "b": 1, "actuation": {"amplitude": 1, "frequency": 1}})")),
                   "from 0 to 0.99, found 1"));
    // where the ends coincide a spring has no direction, whatever its rest length: they would never part
    const auto between = [](const char* x, const char* more) {
        return refusal(concat(head, R"("vertices": [{"position": [1, 1, 1]}, {"position": [)", x,
                              R"(, 1, 1]}],
        "springs": [{"a": 0, "b": 1)",
                              more, "}]}"));
    };
    const std::string none = "f:2:21: this spring has no direction: vertices 0 and 1 stand in the same place";
    CHECK(between("1", "").find(none) == 0);
    CHECK(between("1", R"(, "restLength": 1)").find(none) == 0);
    CHECK(between("1.00000001", R"(, "restLength": 1)").find(none) == 0);  // the same float
    CHECK(between("1.000001", R"(, "restLength": 1)").empty());
}

TEST_CASE("triangles that cannot be are refused", "[molecule]") {
    CHECK(refusal(withTriangles("[0, 1, 2], [0, 2, 3]")).empty());
    CHECK(mentions(refusal(withTriangles("[0, 1, 4]")), "vertex index 4 is out of range"));
    CHECK(
        mentions(refusal(withTriangles("[0, 1, 2], [0, 2, 2]")), "three different vertices, found 0, 2, 2"));
    CHECK(mentions(refusal(withTriangles("[0, 1]")), "expected an array of 3 numbers, found 2"));
    CHECK(mentions(refusal(withTriangles("[0, 1, \"2\"]")), "(at $.triangles[0][2])"));
}

TEST_CASE("more vertices than the limit are refused", "[molecule]") {
    std::string vertices = R"({"position": [0, 0, 0]})";
    for (int i = 0; i < maxMoleculeVertices; ++i)
        vertices += R"(,{"position": [0, 0, 0]})";
    CHECK(mentions(refusal(withVertex(vertices)), "expected at most 65536 vertices, found 65537"));
}

TEST_CASE("shipped molecules are read and come back from writing", "[molecule]") {
    const std::vector<std::string> files = shippedFiles();
    CHECK(files.size() >= 7);
    for (const std::string& file : files) {
        const Molecule m = readMolecule(file);
        CHECK(m.name == std::filesystem::path(file).stem().string());
        const std::string again = writeMolecule(m);
        const Molecule n = parseMolecule(again, file);
        CHECK(writeMolecule(n) == writeMolecule(m));
        REQUIRE((n.vertices.size() == m.vertices.size() && n.springs.size() == m.springs.size()));
        for (size_t i = 0; i < m.vertices.size(); ++i) {
            CHECK((m.vertices[i].position == n.vertices[i].position && m.vertices[i].uv == n.vertices[i].uv));
            CHECK((m.vertices[i].mass == n.vertices[i].mass && m.vertices[i].pinned == n.vertices[i].pinned));
        }
        for (size_t i = 0; i < m.springs.size(); ++i) {
            CHECK((m.springs[i].a == n.springs[i].a && m.springs[i].b == n.springs[i].b));
            CHECK(m.springs[i].stiffness == n.springs[i].stiffness);
            CHECK(m.springs[i].damping == n.springs[i].damping);
        }
    }
}

TEST_CASE("everything optional comes back from writing", "[molecule]") {
    const std::string text = R"({
  "name": "pair",
  "format": "shoal-molecule-1",
  "springs": [
    {"b": 1, "a": 0, "stiffness": 3, "restLength": 0.5, "actuation": )"
                             R"({"phase": 1, "amplitude": 0.1, "frequency": 2}}
  ],
  "vertices": [
    {"mass": 1, "position": [0, 0, 0], "uv": [0.1, 0.2], "pinned": true},
    {"position": [0, 0.3333333333333333, 0], "mass": 2, "comment": "end"}
  ],
  "material": {
    "comment": "green",
    "texture": "x.png",
    "color": [0, 1, 0],
    "secondColor": [0.5, 1, 0],
    "alphaCut": 0.1,
    "translucency": 0.2,
    "roughness": 0.3,
    "pointSize": 0.4
  }
}
)";
    const std::string written = writeMolecule(parseMolecule(text, "f"));
    CHECK(writeMolecule(parseMolecule(written, "f")) == written);
    for (const char* part :
         {"\"name\": \"pair\"", "\"restLength\": 0.5", "\"phase\": 1", "\"amplitude\": 0.1",
          "\"frequency\": 2", "\"uv\": [0.1, 0.2]", "\"pinned\": true", "0.3333333333333333",
          "\"texture\": \"x.png\"", "\"color\": [0, 1, 0]", "\"secondColor\": [0.5, 1, 0]",
          "\"alphaCut\": 0.1", "\"translucency\": 0.2", "\"roughness\": 0.3", "\"pointSize\": 0.4"})
        CHECK(written.find(part) != std::string::npos);
}

static bool warns(const std::string& text, const std::string& part) {
    for (const Warning& warning : check(parseMolecule(text, "f")))
        if (warning.message.find(part) != std::string::npos) return true;
    return false;
}

static const char* allSprings =
    R"({"a": 0, "b": 1}, {"a": 0, "b": 2}, {"a": 0, "b": 3}, {"a": 1, "b": 2}, {"a": 1, "b": 3}, {"a": 2, "b": 3})";

static std::string tetrahedron(const std::string& extra, const std::string& more = "") {
    return concat(head,
                  R"("vertices": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, 1, 0]},
        {"position": [0, 0, 1])",
                  extra, "}", more, "], \"springs\": [", allSprings, "]");
}

TEST_CASE("a braced molecule has no warnings", "[molecule]") {
    CHECK(check(parseMolecule(tetrahedron("") + "}", "f")).empty());
    for (const char* name : {"leaf", "fish", "flake", "point", "berry", "snow"})
        CHECK(check(readMolecule(std::string(SHOAL_SOURCE_DIR) + "/molecules/" + name + ".json")).empty());
}

TEST_CASE("what is probably not meant gets a warning", "[molecule]") {
    CHECK(warns(tetrahedron("", R"(, {"position": [5, 5, 5]})") + "}", "vertex 4 is loose"));
    CHECK(warns(tetrahedron("", R"(, {"position": [5, 5, 5], "pinned": true})") + "}",
                "vertex 4 is pinned but holds"));
    CHECK(warns(tetrahedron("") + ", \"triangles\": [[0, 1, 2]]}", "vertex 3 is in no triangle"));
    CHECK(warns(withSprings(R"({"a": 0, "b": 1}, {"a": 2, "b": 3})"), "2 separate parts"));
    CHECK(warns(withSprings(allSprings), "leave 1 motion without any stiffness"));
    CHECK(warns(withSprings(R"({"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3})"), "leave 3 motions"));
    CHECK(warns(tetrahedron(R"(, "pinned": true)") + "}", "vertex 3 is the only one pinned"));
    CHECK(warns(tetrahedron(R"(, "mass": 20000)") + "}", "vertex 3 is 20000 times as heavy"));
    CHECK(
        warns(withTriangles("[0, 1, 2], [0, 3, 2]"), "triangle 1 faces the other way than its neighbour 0"));
    CHECK_FALSE(warns(withTriangles("[0, 1, 2], [0, 2, 3]"), "faces the other way"));
    const std::string oneTurned = withTriangles("[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]");
    CHECK(warns(oneTurned, "triangle 0 faces the other way"));
    CHECK_FALSE(warns(oneTurned, "triangle 1 faces the other way"));
    CHECK(warns(withSprings(R"({"a": 0, "b": 1, "restLength": 2})"),
                "restLength 2 is far from the drawn distance 1"));
    CHECK_FALSE(warns(withSprings(R"({"a": 0, "b": 1, "restLength": 1.05})"), "restLength"));
    CHECK(warns(withVertex(R"({"position": [0, 0, 0], "pinned": true})"), "the only vertex is pinned"));
    const auto still = check(parseMolecule(withVertex(R"({"position": [0, 0, 0], "pinned": true},
        {"position": [1, 0, 0], "pinned": true})"),
                                           "f"));
    REQUIRE(still.size() == 1);
    CHECK(still[0].message == "every vertex is pinned: nothing can move");
    CHECK(warns(
        concat(head,
               R"("vertices": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [2, 0, 0]}],
                              "triangles": [[0, 1, 2]]})"),
        "triangle 0 has no area"));
}

TEST_CASE("warnings point at the line", "[molecule]") {
    const auto warnings = check(parseMolecule(tetrahedron("", ",\n{\"position\": [5, 5, 5]}") + "}", "f"));
    REQUIRE(warnings.size() == 1);
    CHECK(text(warnings[0]) == "f:3:1: vertex 4 is loose: no spring ends at it (at $.vertices[4])");
}

TEST_CASE("mutated files are read or refused with a place, and never crash", "[molecule]") {
    Random random(2024);
    int refused = 0, read = 0;
    for (const std::string& file : shippedFiles()) {
        const std::string whole = readFile(file);
        for (int i = 0; i < 100; ++i) {
            std::string bytes = whole;
            const size_t at = random.next() % bytes.size();
            switch (i % 5) {
            case 0:
                bytes[at] = static_cast<char>(random.next());
                break;
            case 1:
                bytes.resize(at);
                break;
            case 2:
                bytes.erase(at, 1 + random.next() % 20);
                break;
            case 3:
                bytes.insert(at, std::string("-[{\"9e,:}]").substr(random.next() % 10, 1));
                break;
            default:
                bytes.insert(at, bytes.substr(random.next() % bytes.size(), 30));
                break;
            }
            try {
                check(parseMolecule(bytes, "f"));
                ++read;
            } catch (const Error& error) {
                CHECK(error.location().line > 0);
                ++refused;
            }
        }
    }
    CHECK(refused > 300);
    CHECK(read > 10);
}

TEST_CASE("a material says how it is blended", "[molecule]") {
    const auto with = [](const std::string& keys) {
        return concat(head, R"("vertices": [{"position": [0, 0, 0], "mass": 1}], "material": {)", keys, "}}");
    };
    const auto materialOf = [&](const std::string& keys) { return parseMolecule(with(keys), "f").material; };
    const Material plain = materialOf("");
    CHECK((plain.blend == Blend::none && plain.opacity == 1 && plain.sort == DrawSort::frame));
    const Material full =
        materialOf(R"("blend": "alpha", "opacity": 0.25, "sort": "spread", "spreadFrames": 50)");
    CHECK((full.blend == Blend::alpha && full.opacity == 0.25));
    CHECK((full.sort == DrawSort::spread && full.spreadFrames == 50));
    CHECK(materialOf(R"("blend": "additive")").blend == Blend::additive);

    CHECK(mentions(refusal(with(R"("blend": "alfa")")), "alpha"));
    CHECK(mentions(refusal(with(R"("blend": "alpha", "opacity": 1.5)")), "opacity"));
    CHECK(mentions(refusal(with(R"("opacity": 0.5)")), "\"opacity\" needs \"blend\": \"alpha\" or"));
    CHECK(mentions(refusal(with(R"("blend": "additive", "sort": "frame")")),
                   "\"sort\" needs \"blend\": \"alpha\""));
    CHECK(mentions(refusal(with(R"("blend": "alpha", "spreadFrames": 5)")),
                   "\"spreadFrames\" needs \"sort\": \"spread\""));
    CHECK(
        mentions(refusal(with(R"("blend": "alpha", "sort": "spread", "spreadFrames": 0)")), "spreadFrames"));

    Molecule written = parseMolecule(
        with(R"("blend": "alpha", "opacity": 0.25, "sort": "spread", "spreadFrames": 50)"), "f");
    const Material again = parseMolecule(writeMolecule(written), "f").material;
    CHECK((again.blend == Blend::alpha && again.opacity == 0.25));
    CHECK((again.sort == DrawSort::spread && again.spreadFrames == 50));
}
