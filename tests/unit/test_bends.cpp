#include "support/catch.h"

#include <cmath>

#include "compile/plan.h"
#include "core/random.h"
#include "molecule/analysis.h"
#include "molecule/draft.h"
#include "molecule/molecule_file.h"
#include "reference/equations.h"
#include "reference/solve.h"

using namespace shoal;
using namespace shoal::reference;
using glm::dvec3;

// Two triangles across an edge along y, folded by `fold`, rad.
static Molecule wing(double fold) {
    Molecule out;
    const double x = std::cos(fold / 2), z = std::sin(fold / 2);
    out.vertices = {{{0, -0.4, 0}, {}, 0.2, false},
                    {{0, 0.6, 0}, {}, 0.1, false},
                    {{0.5 * x, 0.1, 0.5 * z}, {}, 0.3, false},
                    {{-0.7 * x, -0.2, 0.7 * z}, {}, 0.1, false}};
    for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 2}, {0, 3}, {1, 3}})
        out.springs.push_back({a, b, 200, 0.1, {}, {}});
    out.triangles = {{0, 2, 1}, {0, 1, 3}};
    out.bends = {{0, 1, 2, 3, 0.8, 0.01}};
    return out;
}

static State scattered(const Molecule& molecule, double share) {
    Random random(7);
    State out;
    for (const Vertex& vertex : molecule.vertices) {
        out.position.push_back(vertex.position + share * random.direction());
        out.velocity.push_back(share * random.direction());
    }
    return out;
}

TEST_CASE("a bend resists the angle between its triangles, 2 sin(t/2) of which is what it measures",
          "[bends]") {
    const Molecule flat = wing(0);
    const WeightedSpring bend = weighted(flat, flat.bends[0]);
    CHECK(bend.restLength == 0);
    double sum = 0, squares = 0;
    for (const double weight : bend.weights)
        sum += weight, squares += weight * weight;
    CHECK(std::abs(sum) < 1e-15);
    CHECK(squares == Approx(2));
    for (const double fold : {0.01, 0.5, 2.0}) {
        State state;
        for (const Vertex& vertex : wing(fold).vertices)
            state.position.push_back(vertex.position);
        const Problem problem{.molecule = &flat};
        const double measured = 2 * std::sin(fold / 2);
        CHECK(springEnergy(problem, state) == Approx(0.5 * 0.8 * measured * measured));
        const Molecule folded = wing(fold);
        CHECK(springEnergy({.molecule = &folded}, state) == Approx(0).margin(1e-20));
    }
}

TEST_CASE("a bend's force is the gradient of its energy", "[bends]") {
    for (const double fold : {0.0, 0.7}) {
        CAPTURE(fold);
        Molecule molecule = wing(fold);
        molecule.springs.clear();
        const Problem problem{.molecule = &molecule, .scale = 1.3, .stiffness = 2};
        State state = scattered(molecule, 0.2);
        Equations equations(problem);
        Vectors acceleration;
        const Vectors still(4, dvec3(0));
        equations.springs(state.position, still, 0, acceleration);
        for (size_t i = 0; i < 4; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const double h = 1e-5, before = state.position[i][axis];
                state.position[i][axis] = before + h;
                const double above = springEnergy(problem, state);
                state.position[i][axis] = before - h;
                const double below = springEnergy(problem, state);
                state.position[i][axis] = before;
                CHECK(molecule.vertices[i].mass * acceleration[i][axis] ==
                      Approx(-(above - below) / (2 * h)).margin(1e-8));
            }
    }
}

TEST_CASE("bends keep momentum and angular momentum, and damping takes energy", "[bends]") {
    for (const double fold : {0.0, 0.7}) {
        const Molecule molecule = wing(fold);
        const Problem problem{.molecule = &molecule};
        const State start = scattered(molecule, 0.1), end = integrate(problem, start, 1, 20000);
        CHECK(glm::length(momentum(problem, end) - momentum(problem, start)) < 1e-13);
        CHECK(glm::length(angularMomentum(problem, end) - angularMomentum(problem, start)) < 1e-10);
        CHECK(energy(problem, end) < energy(problem, start));
    }
}

// A strip along x, whose cells are stiff in their plane and hinged to one another: `stiffness` of an edge.
static Molecule strip(int cells, double length, double width, double mass, double stiffness) {
    Molecule out;
    const double cell = length / cells;
    for (int i = 0; i <= cells; ++i)
        for (const double y : {0.0, width})
            out.vertices.push_back({{i * cell, y, 0}, {}, mass / cells / (i % cells ? 2 : 4), false});
    for (int i = 0; i <= cells; ++i) {
        const int a = 2 * i, b = a + 1;
        out.springs.push_back({a, b, 1e4, 0, {}, {}});
        if (i == cells) break;
        for (const auto& [from, to] : {std::pair(a, a + 2), {b, b + 2}, {a, b + 2}, {b, a + 2}})
            out.springs.push_back({from, to, 1e4, 0, {}, {}});
        if (i == 0) continue;
        out.bends.push_back({a, b, a + 2, b - 2, stiffness / 2, 0});
        out.bends.push_back({a, b, b + 2, a - 2, stiffness / 2, 0});
    }
    return out;
}

// Euler-Bernoulli: a free beam bends at 4.730^2 sqrt(E I / (m/l)) / l^2; hinges a distance apart are E I of
// their stiffness times the distance.
TEST_CASE("a strip of hinges bends at the frequency of a free beam", "[bends]") {
    const double length = 1, mass = 0.1, stiffness = 0.02;
    double before = 0;
    for (const int cells : {10, 20, 40}) {
        const Molecule molecule = strip(cells, length, 0.03, mass, stiffness * cells);
        const double bending = stiffness * cells * length / cells;
        const double expected = 4.73004 * 4.73004 * std::sqrt(bending / (mass / length)) / (length * length);
        const double found = analyse(molecule, false).lowestFrequency;
        CAPTURE(cells, found, expected);
        const double error = std::abs(found / expected - 1);
        CHECK(error < 5.0 / (cells * cells));  // of second order in the cell
        if (before > 0) CHECK(error < before / 3);
        before = error;
    }
}

TEST_CASE("a bend takes the last motion without stiffness from a flat sheet", "[bends]") {
    Molecule sheet = wing(0);
    CHECK(analyse(sheet, false).zeroModes == 0);
    CHECK(analyse(sheet, false).bends == 1);
    const double step = analyse(sheet, false).stableStepLeapfrog;
    sheet.bends[0].stiffness = 1e4;
    CHECK(analyse(sheet, false).stableStepLeapfrog < 0.1 * step);
    CHECK(analyse(sheet, false).frequencyBound >= analyse(sheet, false).highestFrequency);
    sheet.bends.clear();
    CHECK(analyse(sheet, false).zeroModes == 1);
}

static Molecule parsed(const std::string& bends, const char* vertex = "[0, 1, 0]") {
    return parseMolecule(R"({"format": "shoal-molecule-1", "name": "wing", "defaults": {"mass": 1},
  "vertices": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": )" +
                             std::string(vertex) + R"(}, {"position": [0, -1, 0]}, {"position": [1, -1, 0]}],
  "bends": )" + bends + "}",
                         "wing.json");
}

TEST_CASE("bends are read and written", "[bends]") {
    const Molecule molecule = parsed(R"([{"a": 0, "b": 1, "c": 2, "d": 3, "stiffness": 2, "damping": 0.5}])");
    REQUIRE(molecule.bends.size() == 1);
    CHECK(molecule.places.bends.size() == 1);
    const Molecule again = parseMolecule(writeMolecule(molecule), "again.json");
    REQUIRE(again.bends.size() == 1);
    CHECK(again.bends[0].d == 3);
    CHECK(again.bends[0].stiffness == 2);
    CHECK(again.bends[0].damping == 0.5);
}

TEST_CASE("bends that mean nothing are refused where they stand", "[bends]") {
    const auto message = [](const std::string& bends, const char* vertex = "[0, 1, 0]") -> std::string {
        try {
            parsed(bends, vertex);
        } catch (const Error& error) {
            return error.location().path + ": " + error.message();
        }
        return "accepted";
    };
    const std::string good = R"({"a": 0, "b": 1, "c": 2, "d": 3, "stiffness": 2})";
    CHECK(message("[" + good + "]") == "accepted");
    CHECK_THAT(message(R"([{"a": 0, "b": 1, "c": 2, "d": 9, "stiffness": 2}])"),
               Catch::StartsWith("$.bends[0].d: vertex index 9 is out of range"));
    CHECK_THAT(message(R"([{"a": 0, "b": 1, "c": 2, "d": 1, "stiffness": 2}])"),
               Catch::StartsWith("$.bends[0].d: a bend needs four different vertices"));
    CHECK_THAT(message(R"([{"a": 0, "b": 1, "c": 2, "d": 3}])"), Catch::Contains("stiffness"));
    CHECK_THAT(message(R"([{"a": 0, "b": 1, "c": 2, "d": 3, "stiffness": -1}])"),
               Catch::StartsWith("$.bends[0].stiffness"));
    CHECK_THAT(message("[" + good + "]", "[2, 0, 0]"),
               Catch::StartsWith("$.bends[0].c: the triangle of vertices 0, 1 and 2 has no area"));
    CHECK_THAT(message(R"([{"a": 0, "b": 2, "c": 1, "d": 3, "stiffness": 2}])", "[0, 0, 0]"),
               Catch::StartsWith("$.bends[0]: this bend has no edge"));
    CHECK_THAT(message("[" + good + R"(, {"a": 1, "b": 0, "c": 3, "d": 2, "stiffness": 2}])"),
               Catch::StartsWith("$.bends[1]: a bend of vertices 3 and 2 across 1-0 exists already"));
}

TEST_CASE("a draft keeps the bends of the vertices that are left", "[bends]") {
    Draft draft(parsed(R"([{"a": 0, "b": 1, "c": 2, "d": 3, "stiffness": 2},
                           {"a": 3, "b": 1, "c": 0, "d": 4, "stiffness": 5}])"));
    removeVertices(draft, {2});
    REQUIRE(draft.molecule.bends.size() == 1);
    CHECK(draft.origins.bends == std::vector<int>{1});
    const Bend& left = draft.molecule.bends[0];
    CHECK(std::array{left.a, left.b, left.c, left.d} == std::array{2, 1, 0, 3});
    CHECK(left.stiffness == 5);
}

TEST_CASE("a run refuses bends, which no solver on the device takes", "[bends]") {
    Scene scene;
    Group& group = scene.groups.emplace_back();
    group.molecule = wing(0.4);
    group.count = 1;
    group.location = {"sheet.scene.json", 3, 5, "$.groups[0]"};
    CHECK_THROWS_WITH(
        compile(scene),
        Catch::StartsWith("sheet.scene.json:3:5: bends are not simulated yet: fold the sheet instead"));
    group.molecule.bends.clear();
    CHECK_NOTHROW(compile(scene));
}
