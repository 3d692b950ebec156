#include "support/catch.h"

#include <cmath>
#include <functional>

#include "molecule/analysis.h"
#include "molecule/molecule_file.h"

using namespace shoal;

static Molecule chain(int count, double mass, double stiffness, double damping) {
    Molecule molecule;
    for (int i = 0; i < count; ++i)
        molecule.vertices.push_back({{i * 0.5, 0, 0}, {}, mass, false});
    for (int i = 0; i + 1 < count; ++i)
        molecule.springs.push_back({i, i + 1, stiffness, damping, {}, {}});
    return molecule;
}

// The folded leaf (fold 0.12) or Decker's flat quad (fold 0), every mass 1.
static Molecule quad(double fold, double stiffness = 100) {
    Molecule molecule;
    const double side[4][2] = {{-0.5, 0}, {0.5, 0}, {0.5, 1}, {-0.5, 1}};
    for (int i = 0; i < 4; ++i)
        molecule.vertices.push_back({{side[i][0], i % 2 ? -fold : fold, -side[i][1]}, {}, 1, false});
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
            molecule.springs.push_back({a, b, stiffness, 0, {}, {}});
    return molecule;
}

static Molecule shipped(const std::string& name) {
    return readMolecule(std::string(SHOAL_SOURCE_DIR) + "/molecules/" + name + ".json");
}

TEST_CASE("two masses on a spring: omega^2 = 2 k / m", "[analysis]") {
    const Analysis a = analyse(chain(2, 0.3, 50, 0), false);
    const double omega = std::sqrt(2 * 50 / 0.3);
    CHECK(a.highestFrequency == Approx(omega).epsilon(1e-12));
    CHECK(a.lowestFrequency == Approx(omega).epsilon(1e-12));
    CHECK(a.frequencyBound == Approx(omega).epsilon(1e-12));
    CHECK(a.rigidModes == 5);  // a line has no turn about itself
    CHECK(a.zeroModes == 0);
    CHECK(a.stableStepEuler == Approx(2 / omega).epsilon(1e-9));
    CHECK(a.stableStepLeapfrog == Approx(2 / omega).epsilon(1e-9));
    CHECK(a.totalMass == Approx(0.6));
    CHECK(a.restEnergy == 0);
}

TEST_CASE("unequal masses share a spring: omega^2 = k (1/m + 1/M)", "[analysis]") {
    Molecule pair = chain(2, 1, 10, 0);
    pair.vertices[1].mass = 1e6;
    CHECK(analyse(pair, false).highestFrequency == Approx(std::sqrt(10 * (1 + 1e-6))).epsilon(1e-12));
    pair.vertices[1].pinned = true;
    CHECK(analyse(pair, true).highestFrequency == Approx(std::sqrt(10.0)).epsilon(1e-12));
    CHECK(analyse(pair, true).rigidModes == 2);  // a pendulum swings two ways
    CHECK(analyse(pair, false).rigidModes == 5);
}

TEST_CASE("a chain has the frequencies of a chain", "[analysis]") {
    const Analysis a = analyse(chain(20, 0.1, 30, 0), false);
    const double half = std::sqrt(30 / 0.1), pi = std::acos(-1.0);
    CHECK(a.highestFrequency == Approx(2 * half * std::sin(pi * 19 / 40)).epsilon(1e-10));
    CHECK(a.lowestFrequency == Approx(2 * half * std::sin(pi / 40)).epsilon(1e-10));
    CHECK(a.zeroModes == 36);  // each of 18 inner vertices can leave the line in two directions
}

TEST_CASE("a large molecule's highest frequency is found without its matrix", "[analysis]") {
    const Analysis a = analyse(chain(1000, 0.1, 30, 0.01), false);
    CHECK_FALSE(a.modesKnown);
    const double omega = 2 * std::sqrt(30 / 0.1);
    CHECK(a.highestFrequency == Approx(omega).epsilon(0.03));
    CHECK(a.stableStepEuler == Approx(2 / omega).epsilon(0.05));
}

TEST_CASE("restLength stores energy: k (l - L)^2 / 2", "[analysis]") {
    Molecule pair = chain(2, 1, 10, 0);
    pair.springs[0].restLength = 0.3;
    CHECK(analyse(pair, false).restEnergy == Approx(0.5 * 10 * 0.2 * 0.2));
}

TEST_CASE("a point and a molecule that is all pins have no motion to speak of", "[analysis]") {
    const Analysis point = analyse(chain(1, 2, 0, 0), false);
    CHECK(point.highestFrequency == 0);
    CHECK(point.rigidModes == 3);
    CHECK(point.zeroModes == 0);
    CHECK(std::isinf(point.stableStepEuler));
    Molecule pinned = chain(2, 1, 10, 1);
    for (Vertex& vertex : pinned.vertices)
        vertex.pinned = true;
    CHECK(analyse(pinned, true).rigidModes == 0);
    CHECK(std::isinf(analyse(pinned, true).stableStepLeapfrog));
}

TEST_CASE("a flat quad has a saddle without stiffness, a fold of 0.12 gives it 0.11", "[analysis]") {
    const Analysis flat = analyse(quad(0, 1), false), folded = analyse(quad(0.12, 1), false);
    CHECK(flat.rigidModes == 6);
    CHECK(flat.zeroModes == 1);
    CHECK(folded.rigidModes == 6);
    CHECK(folded.zeroModes == 0);
    // The measured 0.11 is the stiffness, the square of the frequency, at k = m = 1.
    CHECK(folded.lowestFrequency * folded.lowestFrequency == Approx(0.11).margin(0.005));
}

TEST_CASE("a cross braced by 29 springs has one free bend, by 25 four", "[analysis]") {
    Molecule cross = shipped("cross-braced");
    REQUIRE(cross.springs.size() == 29);
    CHECK(analyse(cross, false).zeroModes == 1);
    cross.springs.resize(25);  // without the upper ring
    CHECK(analyse(cross, false).zeroModes == 4);
}

TEST_CASE("pins take rigid motions away: three hold, two make a hinge", "[analysis]") {
    Molecule molecule = quad(0.12);
    const int expected[] = {6, 3, 1, 0, 0};
    for (int pins = 0; pins <= 4; ++pins) {
        for (int i = 0; i < 4; ++i)
            molecule.vertices[size_t(i)].pinned = i < pins;
        CHECK(analyse(molecule, true).rigidModes == expected[pins]);
        CHECK(analyse(molecule, true).zeroModes == 0);
    }
}

// Whether 4000 steps of one vertex on a spring of rate omega and damping rate c stay bounded.
static bool bounded(const std::function<void(double&, double&)>& step) {
    double x = 1, v = 0;
    for (int i = 0; i < 4000; ++i)
        step(x, v);
    return std::abs(x) < 1e3;
}

TEST_CASE("the stable steps are those of the schemes, to 1 %, with damping", "[analysis]") {
    for (const double damping : {0.0, 0.5, 3.0, 20.0}) {
        const Analysis a = analyse(chain(2, 1, 50, damping), false);
        const double k = 100, c = 2 * damping;  // of the distance, by the reduced mass 1/2
        for (const double share : {0.99, 1.01}) {
            const double h = share * a.stableStepEuler;
            CHECK(bounded([&](double& x, double& v) {
                      v += h * (-k * x - c * v);
                      x += h * v;
                  }) == (share < 1));
            const double g = share * a.stableStepLeapfrog;
            double force = -k;  // at x = 1, v = 0
            CHECK(bounded([&](double& x, double& v) {
                      v += 0.5 * g * force;
                      x += g * v;
                      force = -k * x - c * (v + 0.5 * g * force);
                      v += 0.5 * g * force;
                  }) == (share < 1));
        }
    }
}

TEST_CASE("deformed shapes stay below the frequency bound", "[analysis]") {
    for (const char* name : {"leaf", "fish", "flake", "cross"}) {
        Molecule molecule = shipped(name);
        const double bound = analyse(molecule, false).frequencyBound;
        CHECK(analyse(molecule, false).highestFrequency <= bound * (1 + 1e-9));
        for (Vertex& vertex : molecule.vertices)
            vertex.position *= glm::dvec3(0.05, 1, 0.3);
        CHECK(analyse(molecule, false).highestFrequency <= bound * (1 + 1e-9));
    }
}

TEST_CASE("the shipped molecules are what their descriptions say", "[analysis]") {
    CHECK(shipped("point").vertices.size() == 1);
    CHECK(analyse(shipped("quad"), false).zeroModes == 1);
    const Molecule cross = shipped("cross"), fish = shipped("fish"), leaf = shipped("leaf");
    CHECK((cross.vertices.size() == 12 && cross.springs.size() == 30 && cross.triangles.size() == 10));
    CHECK((fish.vertices.size() == 24 && fish.springs.size() == 96));
    CHECK(analyse(fish, false).zeroModes == 0);
    CHECK(analyse(shipped("flake"), false).zeroModes == 0);

    const Analysis held = analyse(leaf, true), loose = analyse(leaf, false);
    CHECK(held.rigidModes == 0);
    CHECK(held.zeroModes == 0);
    CHECK(loose.zeroModes == 0);
    CHECK((held.totalMass > 0.3e-3 && held.totalMass < 1e-3));
    CHECK(loose.highestFrequency < 300);
    CHECK(std::min(held.stableStepLeapfrog, loose.stableStepLeapfrog) >
          1.0 / 240);  // 4 substeps at 60 frames/s
    CHECK(leaf.size() > 0.06);
    CHECK(leaf.size() < 0.075);
}
