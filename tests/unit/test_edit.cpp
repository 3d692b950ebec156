// An editor's changes of a molecule, its mirror image, undo, and what is kept of what is not saved.
#include "author/edit.h"

#include <cstdlib>
#include <filesystem>
#include <map>

#include "core/file.h"
#include "molecule/analysis.h"
#include "molecule/molecule_file.h"
#include "molecule/skin.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Two vertices to either side of x = 0 and two on it; 4 faces in front.
constexpr const char* kite = R"({
  "format": "shoal-molecule-1", "comment": "kept",
  "defaults": {"mass": 1, "stiffness": 10},
  "vertices": [{"position": [0, 0, 0]}, {"position": [1, 1, 0]}, {"position": [0, 3, 0]},
               {"position": [-1, 1, 0], "comment": "wing"}, {"position": [0, 1, 1]}],
  "springs": [{"a": 0, "b": 1}, {"a": 0, "b": 3}, {"a": 2, "b": 1}, {"a": 2, "b": 3}],
  "triangles": [[0, 1, 4], [0, 4, 3]]
}
)";

Draft opened() {
    return Draft(parseMolecule(kite, "kite.json"));
}

const glm::dvec3& at(const Draft& draft, int vertex) {
    return draft.molecule.vertices[size_t(vertex)].position;
}

// Where the documents of a test keep what is not saved.
struct State {
    Scratch scratch;
    State() { ::setenv("XDG_STATE_HOME", scratch.path("state").c_str(), 1); }
    ~State() { ::unsetenv("XDG_STATE_HOME"); }
    size_t kept() const {
        size_t count = 0;
        std::error_code code;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path("state"), code))
            count += entry.is_regular_file();
        return count;
    }
};

void move(Document& document, double x, int gesture = 0) {
    document.edit(
        "move", [x](Draft& draft) { draft.molecule.vertices[1].position.x = x; }, gesture);
}

double placeOf(const Document& document) {
    return document.molecule().vertices[1].position.x;
}

}  // namespace

TEST_CASE("what is moved moves its image, and stays on the plane of symmetry", "[edit]") {
    Draft draft = opened();
    const Draft before = draft;
    moveVertices(draft, before, {1, 2}, {0.5, 0.25, 0.125}, 0);
    CHECK(at(draft, 1) == glm::dvec3(1.5, 1.25, 0.125));
    CHECK(at(draft, 3) == glm::dvec3(-1.5, 1.25, 0.125));
    CHECK(at(draft, 2) == glm::dvec3(0, 3.25, 0.125));
    CHECK(at(draft, 0) == glm::dvec3(0));
    // from where it was, not from where it is
    moveVertices(draft, before, {1, 2}, {0.1, 0, 0}, 0);
    CHECK(at(draft, 1).x == Approx(1.1));
    CHECK(at(draft, 3).x == Approx(-1.1));
    // without symmetry, and both sides at once
    draft = opened();
    moveVertices(draft, opened(), {1}, {1, 0, 0}, -1);
    CHECK(at(draft, 3) == glm::dvec3(-1, 1, 0));
    draft = opened();
    moveVertices(draft, opened(), {1, 3}, {0, 1, 0}, 0);
    CHECK(at(draft, 3) == glm::dvec3(-1, 2, 0));
}

TEST_CASE("what is added and removed is so on both sides", "[edit]") {
    Draft draft = opened();
    const int one = addVertexAt(draft, {2, 0, 0}, 0);
    REQUIRE(draft.molecule.vertices.size() == 7);
    CHECK(at(draft, one + 1) == glm::dvec3(-2, 0, 0));
    addVertexAt(draft, {1e-5, 0, 2}, 0);  // on the plane, as near as makes no difference
    REQUIRE(draft.molecule.vertices.size() == 8);
    CHECK(at(draft, 7).x == 0);

    connect(draft, one, 1, 0);
    CHECK(springBetween(draft.molecule, one + 1, 3) >= 0);
    const int face = addFace(draft, one, 1, 0, 0);
    REQUIRE(face >= 0);
    // a mirror turns round
    const Triangle& image = draft.molecule.triangles[size_t(face) + 1];
    CHECK(glm::ivec3(image.a, image.b, image.c) == glm::ivec3(one + 1, 0, 3));

    ElementSet selected;
    selected.vertices = {one};
    selected.springs = {springBetween(draft.molecule, 0, 1)};
    removeSelected(draft, selected, 0);
    CHECK(draft.molecule.vertices.size() == 6);
    CHECK(springBetween(draft.molecule, 0, 1) == -1);
    CHECK(springBetween(draft.molecule, 0, 3) == -1);
    CHECK(springBetween(draft.molecule, 2, 3) >= 0);
    CHECK(draft.molecule.triangles.size() == 2);
    CHECK(selectedSprings(draft.molecule, {{1, 2}, {}, {}}).size() == 1);
}

TEST_CASE("a skin stays where it was when a vertex that it hung on is removed", "[edit]") {
    Draft draft(readMolecule(SHOAL_SOURCE_DIR "/molecules/minnow.json"));
    const std::vector<SkinVertex> before = draft.molecule.skin.vertices;
    REQUIRE_FALSE(before.empty());
    removeVertices(draft, {9});
    REQUIRE(problemOf(draft.molecule).empty());
    placeSkin(draft.molecule);
    double worst = 0;
    for (size_t i = 0; i < before.size(); ++i)
        worst = std::max(worst, glm::distance(before[i].position, draft.molecule.skin.vertices[i].position));
    CHECK(worst < 1e-5 * draft.molecule.size());
}

TEST_CASE("soft shapes are braced", "[edit]") {
    Draft draft = opened();
    for (const int v : {0, 1, 2, 3})
        addSpring(draft, v, 4);
    REQUIRE(analyse(draft.molecule, false).zeroModes > 0);
    CHECK(braceSoftModes(draft) > 0);
    CHECK(analyse(draft.molecule, false).zeroModes == 0);
    CHECK(braceSoftModes(draft) == 0);
}

TEST_CASE("undo takes back a gesture as a whole, redo gives it again", "[edit]") {
    const State state;
    Document document(state.scratch.write("kite.json", kite));
    CHECK_FALSE(document.undo());
    const int gesture = document.newGesture();
    move(document, 2, gesture);
    move(document, 3, gesture);
    move(document, 4);
    CHECK(document.unsaved());
    CHECK(document.undo());
    CHECK(placeOf(document) == 3);
    CHECK(document.undo());
    CHECK(placeOf(document) == 1);
    CHECK_FALSE(document.unsaved());
    CHECK_FALSE(document.undo());
    CHECK(document.redoLabel() == "move");
    CHECK(document.redo());
    CHECK(placeOf(document) == 3);
    move(document, 5);  // what was taken back is gone
    CHECK_FALSE(document.redo());
    CHECK(document.undo());
    CHECK(placeOf(document) == 3);
    // what goes on after that is a step of its own
    const int other = document.newGesture();
    move(document, 6, other);
    document.undo();
    move(document, 7, other);
    CHECK(document.undo());
    CHECK(placeOf(document) == 3);
}

TEST_CASE("a document is saved, goes back and is saved again, byte for byte", "[edit]") {
    const State state;
    const std::string file = state.scratch.write("kite.json", kite);
    Document document(file);
    move(document, 1.5);
    document.edit("remove", [](Draft& draft) { removeVertices(draft, {4}); });
    document.save();
    CHECK_FALSE(document.unsaved());
    CHECK(readMolecule(file).vertices.size() == 4);
    document.undo();
    document.undo();
    CHECK(document.unsaved());
    document.save();
    const Molecule back = readMolecule(file);
    CHECK(back.vertices.size() == 5);
    CHECK(back.triangles.size() == 2);
    CHECK(readFile(file).find("kept") != std::string::npos);
    // a move alone comes back to the byte
    const std::string now = readFile(file);
    move(document, 7);
    document.save();
    document.undo();
    document.save();
    CHECK(readFile(file) == now);
}

TEST_CASE("what cannot be saved loses nothing", "[edit]") {
    const State state;
    const std::string file = state.scratch.write("kite.json", kite);
    Document document(file);
    document.edit("wrong", [](Draft& draft) { draft.molecule.vertices[1].position = glm::dvec3(0); });
    CHECK_FALSE(document.problem().empty());
    CHECK_THROWS_AS(document.save(), Error);
    CHECK(readFile(file) == kite);
    document.undo();
    CHECK(document.problem().empty());
    // nor what another program wrote meanwhile
    move(document, 2);
    state.scratch.write("kite.json", std::string(kite) + "\n");
    CHECK_THROWS_AS(document.save(), Error);
    CHECK(readFile(file) == std::string(kite) + "\n");
    CHECK(document.unsaved());
}

TEST_CASE("one side becomes the image of the other", "[edit]") {
    // two vertices on the plane x = 0, two on its left, and on its right one that is to go
    Molecule half;
    for (const glm::dvec3& x : {glm::dvec3(0, 0, 0), {0, 1, 0}, {-1, 0, 0}, {-1, 1, 0.2}, {0.7, 0.3, 0}})
        half.vertices.push_back({x, {}, 0.5, x.x < -0.5});
    half.springs = {
        {0, 1, 10, 1, {}, {}}, {0, 2, 20, 1, 1.5, {}}, {1, 3, 30, 1, {}, {}}, {0, 4, 40, 1, {}, {}}};
    half.triangles = {{0, 1, 3}, {0, 3, 2}};
    Draft draft(half);
    CHECK(mirrorSide(draft, -1) == "choose the axis of symmetry first");
    REQUIRE(mirrorSide(draft, 0).empty());
    const Molecule& m = draft.molecule;
    CHECK(m.vertices.size() == 6);
    CHECK(m.springs.size() == 5);
    CHECK(m.triangles.size() == 4);
    CHECK(problemOf(m).empty());
    const std::vector<int> image = mirrored(m, 0);
    for (size_t v = 0; v < m.vertices.size(); ++v) {
        REQUIRE(image[v] >= 0);
        CHECK(m.vertices[v].pinned == m.vertices[size_t(image[v])].pinned);
    }
    const int there = springBetween(m, image[0], image[2]);
    REQUIRE(there >= 0);
    CHECK(m.springs[size_t(there)].stiffness == 20);
    CHECK(m.springs[size_t(there)].restLength == 1.5);
    // all faces look the same way
    double up = 0;
    for (const Triangle& t : m.triangles) {
        const auto at = [&](int v) { return m.vertices[size_t(v)].position; };
        const double z = glm::cross(at(t.b) - at(t.a), at(t.c) - at(t.a)).z;
        CHECK(z * (up == 0 ? z : up) > 0);
        up = z;
    }
    // what is symmetric stays as it is
    Draft again(m);
    REQUIRE(mirrorSide(again, 0).empty());
    CHECK(again.molecule.vertices.size() == 6);
    CHECK(again.molecule.springs.size() == 5);
    CHECK_FALSE(mirrorSide(again, 2).empty());  // nothing is below z = 0
}

TEST_CASE("triangles are subdivided without a gap, and the mass stays", "[edit]") {
    Draft whole(parseMolecule(kite, "kite.json"));
    const auto massOf = [](const Draft& draft) {
        double out = 0;
        for (const Vertex& vertex : draft.molecule.vertices)
            out += vertex.mass;
        return out;
    };
    const auto areaOf = [&](const Draft& draft) { return massOf(draft) / densityOf(draft.molecule); };
    const double mass = massOf(whole), area = areaOf(whole);
    const size_t triangles = whole.molecule.triangles.size();
    Draft one = whole;
    REQUIRE(subdivide(whole, {}).empty());
    CHECK(whole.molecule.triangles.size() == 4 * triangles);
    REQUIRE(subdivide(one, {0}).empty());
    CHECK(one.molecule.triangles.size() > triangles + 2);
    CHECK(one.molecule.triangles.size() < 4 * triangles);
    for (const Draft* draft : {&whole, &one}) {
        CHECK(problemOf(draft->molecule).empty());
        CHECK(massOf(*draft) == Approx(mass));
        CHECK(areaOf(*draft) == Approx(area));
        // every edge has one triangle at either side, or is on the border, where no vertex lies within it
        std::map<std::pair<int, int>, int> edges;
        for (const Triangle& t : draft->molecule.triangles)
            for (const auto& [a, b] : {std::pair(t.a, t.b), {t.b, t.c}, {t.c, t.a}})
                ++edges[{a, b}];
        for (const auto& [edge, count] : edges) {
            CHECK(count == 1);
            CHECK(springBetween(draft->molecule, edge.first, edge.second) >= 0);
            for (const Vertex& vertex : draft->molecule.vertices) {
                const auto at = [&](int v) { return draft->molecule.vertices[size_t(v)].position; };
                const double off = glm::distance(vertex.position, 0.5 * (at(edge.first) + at(edge.second)));
                CHECK(off > 1e-9);
            }
        }
    }
    Draft none{Molecule()};
    CHECK_FALSE(subdivide(none, {}).empty());
    CHECK_FALSE(weigh(none, 1).empty());
}

TEST_CASE("vertices are weighed by the area around them", "[edit]") {
    Draft draft(parseMolecule(kite, "kite.json"));
    REQUIRE(weigh(draft, 0.3).empty());
    std::set<int> with;
    for (const Triangle& t : draft.molecule.triangles)
        with.insert({t.a, t.b, t.c});
    const Molecule before = parseMolecule(kite, "kite.json");
    for (size_t v = 0; v < before.vertices.size(); ++v)
        if (!with.contains(int(v))) CHECK(draft.molecule.vertices[v].mass == before.vertices[v].mass);
    Molecule all = draft.molecule;
    for (size_t v = 0; v < all.vertices.size(); ++v)
        if (!with.contains(int(v))) all.vertices[v].mass = 0;
    CHECK(densityOf(all) == Approx(0.3));
}

TEST_CASE("a new document makes its file when it is saved", "[edit]") {
    const State state;
    const std::string file = state.scratch.path("new.json");
    const Molecule begin = parseMolecule(kite, "kite.json");
    {
        Document document(file, begin);
        CHECK(document.unsaved());
        move(document, 2);
        document.keep();
        CHECK_FALSE(std::filesystem::exists(file));
    }
    Document document(file, begin);
    REQUIRE(document.recovered());
    document.takeRecovered();
    document.save();
    CHECK_FALSE(document.unsaved());
    CHECK(state.kept() == 0);
    CHECK(placeOf(Document(file)) == 2);
    move(document, 3);
    document.save();
    CHECK(placeOf(Document(file)) == 3);
    CHECK_THROWS_AS(Document(file, begin), Error);
    CHECK_THROWS_AS(Document(state.scratch.write("plain", "") + "/new.json", begin), Error);

    // nor is what another program made meanwhile lost
    const std::string other = state.scratch.path("other.json");
    Document late(other, begin);
    writeFile(other, std::string_view("{}"));
    CHECK_THROWS_AS(late.save(), Error);
    CHECK(readFile(other) == "{}");
}

TEST_CASE("what is not saved is kept until it is", "[edit]") {
    const State state;
    const std::string file = state.scratch.write("kite.json", kite);
    {
        Document crashes(file);
        CHECK_FALSE(crashes.keep());
        CHECK(state.kept() == 0);
        move(crashes, 2);
        CHECK_FALSE(crashes.keep());
        CHECK(state.kept() == 1);
    }
    {
        Document next(file);
        REQUIRE(next.recovered());
        CHECK(placeOf(next) == 1);
        next.closeInOrder();  // without an answer: it stays
        CHECK(state.kept() == 1);
        next.takeRecovered();
        CHECK(placeOf(next) == 2);
        CHECK(next.unsaved());
        next.save();
        CHECK(state.kept() == 0);
        CHECK(readFile(file).find("\"wing\"") != std::string::npos);
    }
    {
        Document third(file);
        CHECK_FALSE(third.recovered());
        move(third, 9);
        third.keep();
    }
    // damaged, it is nothing
    for (const auto& entry : std::filesystem::recursive_directory_iterator(state.scratch.path("state")))
        if (entry.is_regular_file()) writeFile(entry.path(), std::string_view("{"));
    Document fourth(file);
    CHECK_FALSE(fourth.recovered());
}

TEST_CASE("a file that another program changed is taken as one step", "[edit]") {
    const State state;
    const std::string file = state.scratch.write("kite.json", kite);
    Document document(file);
    CHECK_FALSE(document.changedOnDisk());
    std::string other = kite;
    other.replace(other.find("[1, 1, 0]"), 9, "[8, 1, 0]");
    state.scratch.write("kite.json", other);
    std::filesystem::last_write_time(file,
                                     std::filesystem::file_time_type::clock::now() + std::chrono::seconds(2));
    CHECK(document.changedOnDisk());
    document.reload();
    CHECK_FALSE(document.changedOnDisk());
    CHECK(placeOf(document) == 8);
    CHECK_FALSE(document.unsaved());
    CHECK(document.undo());
    CHECK(placeOf(document) == 1);
    state.scratch.write("kite.json", "{");
    CHECK_THROWS_AS(document.reload(), Error);
    CHECK(placeOf(document) == 1);
}
