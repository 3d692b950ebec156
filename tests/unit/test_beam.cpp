// Beams against their closed forms, and molecules under loads against those of tiny cases.
#include <cmath>

#include "author/beam.h"
#include "molecule/statics.h"
#include "unit/from_mesh.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr double pi = std::numbers::pi;
const BeamMaterial sheet{4e7, 800, 3e-4};

// The strip of 0.1 by 0.2 m; with `pointed`, a triangle of that base and height.
Mesh plan(bool pointed) {
    Mesh mesh = strip(10);
    for (auto* places : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& place : *places)
            if (pointed) place.x *= 1 - place.y / 0.2;
    return mesh;
}

const MassSpread upright{{}, {0, 1, 0}, {0, 0, 1}, 0};

}  // namespace

TEST_CASE("the beam of a strip has the figures of Euler and Bernoulli", "[beam]") {
    const Beam beam = beamOf(plan(false), upright, sheet);
    const double length = 0.2, stiffness = 4e7 * 0.1 * std::pow(3e-4, 3) / 12;
    const double weight = 800 * 3e-4 * 0.1 * 9.81;  // N/m
    const double unit = std::sqrt(stiffness / (weight / 9.81 * std::pow(length, 4))) / (2 * pi);
    REQUIRE(beam.whole());
    CHECK(sagOf(beam, length, 9.81, 0) ==
          Approx(weight * std::pow(length, 4) / (8 * stiffness)).epsilon(1e-3));
    CHECK(sagOf(beam, length, 0, 1) == Approx(std::pow(length, 3) / (3 * stiffness)).epsilon(1e-3));
    CHECK(sagOf(beam, length / 2, 0, 1) == Approx(5 * std::pow(length, 3) / (48 * stiffness)).epsilon(2e-3));
    // [Blevins 1979]
    const std::vector<BeamMode> clamped = modesOf(beam, true, 3), free = modesOf(beam, false, 2);
    CHECK(clamped[0].frequency == Approx(3.516 * unit).epsilon(1e-3));
    CHECK(clamped[1].frequency == Approx(22.034 * unit).epsilon(1e-3));
    CHECK(clamped[2].frequency == Approx(61.697 * unit).epsilon(2e-3));
    CHECK(free[0].frequency == Approx(22.373 * unit).epsilon(1e-3));
    CHECK(free[1].frequency == Approx(61.673 * unit).epsilon(2e-3));
    CHECK(bucklingLoad(beam) == Approx(pi * pi * stiffness / (4 * length * length)).epsilon(1e-3));
    const Beam half = beam.from(0.1);
    CHECK(sagOf(half, length, 0, 1) == Approx(std::pow(0.1, 3) / (3 * stiffness)).epsilon(1e-3));
    CHECK(modesOf(half.turned(), true, 1)[0].frequency == Approx(4 * clamped[0].frequency).epsilon(1e-3));
}

// A load on its tip bends it to a circle: the sag is P L^3 / 2 E I of its base.
TEST_CASE("the beam of a triangle bends to a circle", "[beam]") {
    const Beam beam = beamOf(plan(true), upright, sheet);
    const double base = 4e7 * 0.1 * std::pow(3e-4, 3) / 12;
    CHECK(sagOf(beam, 0.2, 0, 1) == Approx(std::pow(0.2, 3) / (2 * base)).epsilon(5e-3));
    CHECK(sagOf(beam, 0.1, 0, 1) == Approx(std::pow(0.1, 2) * 0.2 / (2 * base)).epsilon(5e-3));
}

TEST_CASE("the beam of a body has its section, and shear", "[beam]") {
    Mesh mesh;
    const double length = 0.3, width = 0.06, height = 0.03;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(width * (corner & 1), height * (corner >> 1 & 1), length * (corner >> 2));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    completeMesh(mesh);
    const MassSpread along{{}, {0, 0, 1}, {0, 1, 0}, 0};
    const Beam beam = beamOf(mesh, along, {1e5, 1000, 0});
    const double stiffness = 1e5 * width * std::pow(height, 3) / 12;
    const double shear = 5.0 / 6 * 1e5 / 2.6 * width * height;
    CHECK(sagOf(beam, length, 0, 1) ==
          Approx(std::pow(length, 3) / (3 * stiffness) + length / shear).epsilon(2e-3));
    double mass = 0;
    for (const double slice : beam.mass)
        mass += slice;
    CHECK(mass == Approx(1000 * length * width * height).epsilon(1e-9));
}

// A stiff bar from a pin, whose end is held by springs across it: it falls over at k times its length.
static Molecule bar(double stiffness, double across) {
    Molecule molecule;
    molecule.vertices = {{{0, 0, 0}, {}, 1, true},
                         {{0.5, 0, 0}, {}, 2, false},
                         {{0.5, 1, 0}, {}, 1, true},
                         {{0.5, 0, 1}, {}, 1, true}};
    molecule.springs = {{0, 1, stiffness, 0, {}, {}}, {1, 2, across, 0, {}, {}}, {1, 3, across, 0, {}, {}}};
    return molecule;
}

TEST_CASE("a molecule under loads: displacements, frequencies and buckling of a bar", "[statics]") {
    const Molecule molecule = bar(1000, 20);
    const VertexVectors loads = {{}, {-3, 4, 0}, {}, {}};
    const VertexVectors moved = displacements(molecule, true, loads);
    CHECK(moved[1].x == Approx(-3.0 / 1000));
    CHECK(moved[1].y == Approx(4.0 / 20));
    CHECK(std::abs(moved[1].z) < 1e-12);
    CHECK(moved[0] == glm::dvec3(0));
    CHECK(frequenciesLike(molecule, true, {{{}, {1, 0, 0}, {}, {}}})[0] == Approx(std::sqrt(1000 / 2.0)));
    CHECK(frequenciesLike(molecule, true, {{{}, {0, 1, 0}, {}, {}}})[0] == Approx(std::sqrt(20 / 2.0)));
    CHECK(bucklingFactor(molecule, {{}, {-1, 0, 0}, {}, {}}) == Approx(20 * 0.5));
    CHECK(std::isinf(bucklingFactor(molecule, {{}, {1, 0, 0}, {}, {}})));
    Molecule loose = molecule;
    loose.springs.pop_back();
    CHECK_THROWS_AS(displacements(loose, true, loads), Error);
}

// Two masses on a spring that nothing holds: a load on the first moves the whole, and stretches the spring by
// what is left, F M / (m + M).
TEST_CASE("loads on a free molecule are those that do not move it as a whole", "[statics]") {
    Molecule molecule;
    molecule.vertices = {{{0, 0, 0}, {}, 1, false}, {{1, 0, 0}, {}, 3, false}};
    molecule.springs = {{0, 1, 50, 0, {}, {}}};
    const VertexVectors moved = displacements(molecule, false, {{8, 0, 0}, {}});
    CHECK(moved[0].x - moved[1].x == Approx(8 * 0.75 / 50));
    CHECK(moved[0].x * 1 + moved[1].x * 3 == Approx(0).margin(1e-12));
    CHECK(frequenciesLike(molecule, false, {{{1, 0, 0}, {}}})[0] == Approx(std::sqrt(50 / 0.75)));
}
