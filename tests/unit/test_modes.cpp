// The motions of molecules, against closed forms.

#include <cmath>

#include "molecule/analysis.h"
#include "molecule/molecule_file.h"
#include "support/catch.h"
#include "support/shapes.h"

using namespace shoal;

namespace {

Molecule pairOf(double massA, double massB, double stiffness) {
    Molecule m;
    m.vertices = {{{0, 0, 0}, {}, massA, false}, {{2, 0, 0}, {}, massB, false}};
    m.springs = {{0, 1, stiffness, 0, {}, {}}};
    return m;
}

// N: what the springs do when the molecule is moved by a little of the mode, per metre.
double resistance(const Molecule& m, const Mode& mode) {
    double out = 0;
    for (const Spring& s : m.springs) {
        const glm::dvec3 n =
            glm::normalize(m.vertices[size_t(s.a)].position - m.vertices[size_t(s.b)].position);
        out = std::max(out, std::abs(glm::dot(n, mode.shape[size_t(s.a)] - mode.shape[size_t(s.b)])));
    }
    return out;
}

}  // namespace

TEST_CASE("two masses on a spring have one mode, of their reduced mass", "[modes]") {
    const std::vector<Mode> modes = modesOf(pairOf(1, 3, 12), false, 9);
    REQUIRE(modes.size() == 1);
    CHECK(modes[0].frequency == Approx(4));  // sqrt(k (1/1 + 1/3))
    CHECK(std::abs(modes[0].shape[0].x) == Approx(1));
    CHECK(modes[0].shape[1].x == Approx(-modes[0].shape[0].x / 3));
    CHECK(std::abs(modes[0].shape[0].y) < 1e-12);
}

TEST_CASE("what nothing resists comes first, and no motion of the whole is among it", "[modes]") {
    Molecule square;
    for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
        square.vertices.push_back({p, {}, 0.5, false});
    for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
            square.springs.push_back({a, b, 10, 0, {}, {}});
    const std::vector<Mode> modes = modesOf(square, false, 99);
    REQUIRE(modes.size() == 6);  // 12 coordinates less 6
    CHECK(modes[0].frequency == 0);
    CHECK(modes[1].frequency > 1);
    CHECK(resistance(square, modes[0]) < 1e-9);
    // the saddle: corners up and down in turn, none of it a turn or a shift
    glm::dvec3 sum(0);
    for (const glm::dvec3& u : modes[0].shape) {
        CHECK(std::abs(u.z) == Approx(1).epsilon(1e-6));
        sum += u;
    }
    CHECK(glm::length(sum) < 1e-9);
}

TEST_CASE("as many modes without stiffness as the analysis counts", "[modes]") {
    for (const char* name : {"leaf", "cross", "cross-braced", "fish", "quad", "flake"})
        for (const bool pinned : {false, true}) {
            const Molecule m = readMolecule(concat(SHOAL_SOURCE_DIR "/molecules/", name, ".json"));
            const Analysis analysis = analyse(m, pinned);
            const std::vector<Mode> modes = modesOf(m, pinned, 1000);
            INFO(name << (pinned ? ", pinned" : ""));
            int zeros = 0;
            double lowest = 0, highest = 0;
            for (const Mode& mode : modes) {
                zeros += mode.frequency == 0;
                if (mode.frequency > 0 && lowest == 0) lowest = mode.frequency;
                highest = std::max(highest, mode.frequency);
                if (mode.frequency == 0) CHECK(resistance(m, mode) < 1e-4);
                for (size_t i = 0; i < m.vertices.size(); ++i)
                    if (pinned && m.vertices[i].pinned) CHECK(mode.shape[i] == glm::dvec3(0));
            }
            CHECK(zeros == analysis.zeroModes);
            CHECK(lowest == Approx(analysis.lowestFrequency));
            CHECK(highest == Approx(analysis.highestFrequency));
        }
}

TEST_CASE("a single vertex and a molecule without springs have no modes to look at", "[modes]") {
    CHECK(modesOf(test::point(1), false, 5).empty());
    Molecule two = pairOf(1, 1, 1);
    two.springs.clear();
    for (const Mode& mode : modesOf(two, false, 5))
        CHECK(mode.frequency == 0);
}
