// Editing a molecule, and saving it into its own text.
#include "molecule/draft.h"

#include "core/file.h"
#include "core/json.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "support/catch.h"
#include "support/replaced.h"

using namespace shoal;

namespace {

// Its own layout, comments, key order and spelling of numbers.
constexpr const char* squareText = R"({
  "comment": "kept",
  "format": "shoal-molecule-1",
  "vertices": [
    {"position": [0, 0, 0.00], "comment": "root", "pinned": true},
    {"position": [1.0, 0, 0], "mass": 0.50},
    {"comment": "tip", "position": [1, 1, 0]},
    {"position": [0, 1, 0]}
  ],
  "defaults": {"stiffness": 50.0, "mass": 0.10},
  "springs": [
    {"a": 0, "b": 1}, {"b": 2, "a": 1, "comment": "side"},
    {"a": 2, "b": 3}, {"a": 3, "b": 0, "stiffness": 8e1},
    {"a": 0, "b": 2}, {"a": 1, "b": 3}
  ],
  "triangles": [[0, 1, 2], [0, 2, 3]]
}
)";

Draft opened() {
    return Draft(parseMolecule(squareText, "square.json"));
}

}  // namespace

TEST_CASE("a molecule that was not changed is saved byte for byte", "[draft]") {
    CHECK(withEdits(squareText, opened()) == squareText);
    for (const char* name : {"leaf", "fish", "cross", "point"}) {
        const std::string file = concat(SHOAL_SOURCE_DIR "/molecules/", name, ".json"),
                          there = readFile(file);
        CHECK(withEdits(there, Draft(parseMolecule(there, file))) == there);
    }
}

TEST_CASE("what is changed in a molecule changes its own bytes and no other", "[draft]") {
    Draft draft = opened();
    draft.molecule.vertices[2].position.z = 0.25;
    draft.molecule.vertices[0].pinned = false;
    draft.molecule.springs[1].damping = 0.5;
    draft.molecule.springs[3].stiffness = 90;
    std::string expected = replaced(squareText, "\"position\": [1, 1, 0]", "\"position\": [1, 1, 0.25]");
    expected = replaced(expected, ", \"pinned\": true", "");
    expected = replaced(expected, "{\"b\": 2, ", "{\"b\": 2, \"damping\": 0.5, ");
    expected = replaced(expected, "8e1", "90");
    CHECK(withEdits(squareText, draft) == expected);
}

TEST_CASE("what all take from the defaults changes there", "[draft]") {
    Draft draft = opened();
    for (const int i : {0, 1, 2, 4, 5})
        draft.molecule.springs[size_t(i)].stiffness = 60;
    CHECK(withEdits(squareText, draft) == replaced(squareText, "50.0", "60"));
    draft.molecule.springs[1].stiffness = 70;
    const Molecule read = parseMolecule(withEdits(squareText, draft), "square.json");
    CHECK(read.springs[0].stiffness == 60);
    CHECK(read.springs[1].stiffness == 70);
}

TEST_CASE("vertices come and go with what hangs on them, and comments stay with their element", "[draft]") {
    Draft draft = opened();
    removeVertices(draft, {1});
    CHECK(draft.molecule.springs.size() == 3);
    CHECK(draft.molecule.triangles.size() == 1);
    CHECK(springBetween(draft.molecule, 1, 2) >= 0);  // were 2 and 3
    const int added = addVertex(draft, {0.5, 0.5, 1});
    CHECK(draft.molecule.vertices[size_t(added)].mass == 0.1);
    CHECK(addSpring(draft, added, added) == -1);
    const int spring = addSpring(draft, added, 0);
    CHECK(addSpring(draft, 0, added) == spring);
    CHECK(draft.molecule.springs[size_t(spring)].stiffness == 50);
    CHECK(addTriangle(draft, added, 0, 1) >= 0);
    CHECK(addTriangle(draft, 1, added, 0) == -1);

    const std::string saved = withEdits(squareText, draft);
    const Molecule read = parseMolecule(saved, "square.json");
    CHECK(read.vertices.size() == 4);
    CHECK(read.springs.size() == 4);
    CHECK(read.triangles.size() == 2);
    CHECK(read.vertices[1].position == glm::dvec3(1, 1, 0));
    CHECK(saved.find("\"root\"") < saved.find("\"tip\""));
    CHECK(saved.find("\"tip\", \"position\": [1, 1, 0]") != std::string::npos);
    CHECK(saved.find("0.50") == std::string::npos);
    // its springs went with it
    CHECK(saved.find("\"side\"") == std::string::npos);
}

TEST_CASE("the last element of a kind can go, and the first come", "[draft]") {
    Draft draft = opened();
    removeTriangles(draft, {0, 1});
    std::string saved = withEdits(squareText, draft);
    CHECK(parseMolecule(saved, "square.json").triangles.empty());
    Draft again(parseMolecule(saved, "square.json"));
    addTriangle(again, 2, 1, 0);
    saved = withEdits(saved, again);
    REQUIRE(parseMolecule(saved, "square.json").triangles.size() == 1);
    CHECK(parseMolecule(saved, "square.json").triangles[0].a == 2);
}

TEST_CASE("a draft that cannot be read, or is of another file, is not saved", "[draft]") {
    Draft draft = opened();
    draft.molecule.vertices[1].position = {0, 0, 0};
    CHECK(problemOf(draft.molecule).find("stand in the same place") != std::string::npos);
    CHECK_THROWS_AS(withEdits(squareText, draft), Error);
    CHECK(problemOf(opened().molecule).empty());

    Draft other = opened();
    addSpring(other, 0, 1);
    const std::string shorter = replaced(squareText, ", {\"a\": 1, \"b\": 3}", "");
    CHECK_THROWS_AS(withEdits(shorter, other), Error);
}

TEST_CASE("mirror images are found", "[draft]") {
    Molecule m = opened().molecule;
    for (Vertex& vertex : m.vertices)
        vertex.position.x -= 0.5;
    CHECK(mirrored(m, 0) == std::vector<int>{1, 0, 3, 2});
    CHECK(mirrored(m, 2) == std::vector<int>{0, 1, 2, 3});
    CHECK(mirrored(m, 1) == std::vector<int>{0, 1, -1, -1});
}

TEST_CASE("what check finds can be mended", "[draft]") {
    const auto mended = [](Draft draft, Finding::Kind kind) {
        const std::vector<Finding> before = findingsOf(draft.molecule);
        const auto isIt = [kind](const Finding& f) { return f.kind == kind; };
        const auto found = std::find_if(before.begin(), before.end(), isIt);
        REQUIRE(found != before.end());
        REQUIRE(found->mend);
        CHECK_FALSE(found->remedy.empty());
        found->mend(draft);
        const std::vector<Finding> after = findingsOf(draft.molecule);
        return std::none_of(after.begin(), after.end(), isIt);
    };
    Draft draft = opened();
    addVertex(draft, {0.5, 0.5, 1});
    CHECK(mended(draft, Finding::Kind::loose));
    draft = opened();
    std::swap(draft.molecule.triangles[1].b, draft.molecule.triangles[1].c);
    CHECK(mended(draft, Finding::Kind::flipped));
    draft = opened();
    draft.molecule.springs[0].restLength = 2;
    CHECK(mended(draft, Finding::Kind::tension));
    draft = opened();
    const int far = addVertex(draft, {5, 0, 0}), farther = addVertex(draft, {6, 0, 0});
    addSpring(draft, far, farther);
    CHECK(mended(draft, Finding::Kind::apart));
    draft = opened();
    const int between = addVertex(draft, {0.5, 0, 0});
    addTriangle(draft, 0, between, 1);
    CHECK(mended(draft, Finding::Kind::flat));
}
