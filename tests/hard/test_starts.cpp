// Starts that no scene can state: torn, flattened, mirrored, stretched, collapsed and kicked molecules, 16 of
// each; and shapes on which a direction or a normal is 0/0.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.h"
#include "hard/outcome.h"
#include "molecule/molecule_file.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

enum class Start { random, flat, inverted, stretched, collapsed, kicked };
constexpr const char* startNames[] = {
    "random", "flat", "inverted", "stretched 10x", "collapsed to 1e-3", "kicked at 1 km/s"};
constexpr int starts = 6, each = 8;

// Where one vertex starts, from its place in the rest shape relative to the molecule's middle.
glm::dvec3 placed(Start start, const glm::dvec3& x, double size, Random& random) {
    switch (start) {
    case Start::random:
        return size * (glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5);
    case Start::flat:
        return x * glm::dvec3(1, 0, 1);
    case Start::inverted:
        return -x;
    case Start::stretched:
        return 10.0 * x;
    case Start::collapsed:
        return 1e-3 * x;
    case Start::kicked:
        return x;
    }
    return x;
}

void spoil(GroupState& state, const Molecule& molecule) {
    const size_t vertices = molecule.vertices.size();
    glm::dvec3 middle{0};
    for (const Vertex& vertex : molecule.vertices)
        middle += vertex.position / double(vertices);
    Random random(7);
    for (size_t i = 0; i < state.positions.size(); ++i) {
        const size_t m = i / vertices, v = i % vertices;
        const auto start = Start(m / each);
        const glm::dvec3 centre{20.0 * double(m), 0, 0};
        test::moveTo(state, i,
                     centre + placed(start, molecule.vertices[v].position - middle, molecule.size(), random));
        if (start == Start::kicked && v == m % vertices) state.velocities[i] = {600, -640, 480};  // 1 km/s
    }
}

struct Setting {
    Molecule molecule;
    double product = 0;  // w h of the shape at rest
    double ratio = 0;    // damping ratio of the highest mode
};

// The worst rms strain of each kind of start after 5 s.
using Strains = std::vector<double>;

Strains strainsOf(const Solver& solver, const Setting& setting) {
    std::vector<test::Item> items;
    for (int m = 0; m < starts * each; ++m)
        items.push_back(at({20.0 * m, 0, 0}));
    Scene scene = test::sceneOf(setting.molecule, solver.kind, items);
    const Molecule& molecule = scene.groups[0].molecule;
    // what spins keeps its angular momentum and with it its stretch: drag ends both, e^-10 of them is left
    scene.groups[0].drag = {2, 2};
    setSteps(scene, 1 / 60.0, 8);
    Scene measured = scene;
    measured.solver.kind = SolverKind::bdf2Xpbd;  // refuses no step
    const double h = 1 / 480.0, w = compile(measured).groups[0].highestFrequency;
    const double k = setting.product * setting.product / (h * h * w * w);
    scene.groups[0].stiffness = k;
    // springs of stiffness 1 and damping 1: c = 2 zeta k / w gives the mode at w the ratio zeta
    scene.groups[0].damping = 2 * setting.ratio * k / (w * std::sqrt(k));
    Simulation simulation = test::hardSimulation(scene);
    test::startFrom(simulation, [&](GroupState& state) { spoil(state, molecule); });
    test::runChecked(simulation, 300);
    const Snapshot now = simulation.snapshot(0);
    Strains worst(starts, 0);
    for (int m = 0; m < now.count; ++m) {
        double& most = worst[size_t(m / each)];
        const double strain = test::strainOf(molecule, test::stateOf(now, m));
        most = std::isfinite(strain) ? std::max(most, strain) : strain;
    }
    return worst;
}

// One row a start, one simulation a solver.
void judgeStarts(const std::string& label, const Setting& setting) {
    std::map<std::string, Strains> known;
    for (int start = 0; start < starts; ++start) {
        test::holds(concat(startNames[start], ", ", label), [&](const Solver& solver, Judge& judge) {
            if (!known.contains(solver.name)) known[solver.name] = strainsOf(solver, setting);
            judge.atMost("strain", known[solver.name][size_t(start)], 0.3);
        });
    }
}

Molecule unitSprings(Molecule molecule) {
    for (Spring& spring : molecule.springs)
        spring.stiffness = spring.damping = 1;
    return molecule;
}

}  // namespace

TEST_CASE("hard: starts of a leaf", "[hard][starts]") {
    const Molecule leaf = unitSprings(test::leaf(1, 1));
    judgeStarts("leaf, w h 0.3", {leaf, 0.3, 0.05});
    judgeStarts("leaf, w h 30", {leaf, 30, 0.05});
    judgeStarts("leaf, w h 1000", {leaf, 1000, 0.05});
}

TEST_CASE("hard: starts of a fish", "[hard][starts]") {
    const Molecule fish = unitSprings(readMolecule(SHOAL_SOURCE_DIR "/molecules/fish.json"));
    judgeStarts("fish, w h 0.3", {fish, 0.3, 0.05});
    judgeStarts("fish, w h 30", {fish, 30, 0.05});
}

// A molecule 10 times too large at rest has no angular momentum, and springs give it none: every force is
// along a line between two vertices. In units of what it would be if all of the energy were rotation at arm's
// length; 1e-5 is what 2400 roundings of 6e-8 leave at worst, some of them at a tenth of that size. The leaf
// is the same from both sides.
TEST_CASE("hard: angular momentum of a stretched molecule", "[hard][starts]") {
    const auto turn = [](const Solver& solver, Judge& judge, const Molecule& molecule) {
        Scene scene = test::sceneOf(molecule, solver.kind);
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        test::startFrom(simulation, [](GroupState& start) { test::scaleMolecules(start, glm::dvec3(10)); });
        const reference::Problem problem = test::problemOf(scene, 0);
        const auto momentum = [&] {
            return angularMomentum(problem, test::stateOf(simulation.snapshot(0), 0));
        };
        const double energy = reference::energy(problem, test::stateOf(simulation.snapshot(0), 0));
        const double most =
            10 * molecule.size() / 2 * std::sqrt(2 * energy * double(molecule.vertices.size()));
        test::runChecked(simulation, 300);
        judge.atMost("share", glm::length(momentum()) / most, 1e-5);
        judge.report("strain", test::strainOf(molecule, test::stateOf(simulation.snapshot(0), 0)));
    };
    test::holds("angular momentum, stretched leaf",
                [&](const Solver& s, Judge& judge) { turn(s, judge, test::leaf(5000, 3.5)); });
    test::holds("angular momentum, stretched tetrahedron",
                [&](const Solver& s, Judge& judge) { turn(s, judge, test::tetrahedron(5000, 3.5)); });
}

// Where ends coincide there is no direction, where a triangle has no area no normal: finite at every frame,
// with unit normals (to float's rounding of a square root). A file that begins so is refused; a state may
// come to it.
TEST_CASE("hard: degenerate shapes", "[hard][starts]") {
    const char* const names[] = {"coincident vertices", "collinear molecule", "degenerate triangle"};
    for (int shape = 0; shape < 3; ++shape) {
        test::holds(names[shape], [shape](const Solver& solver, Judge& judge) {
            const Molecule molecule = test::leaf(1e3, 1);
            Scene scene = test::sceneOf(molecule, solver.kind, {at({1, 1, 1}, test::turned())});
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].drag = {8, 1};
            setSteps(scene, 1 / 60.0, 16);
            Simulation simulation = test::hardSimulation(scene, true);
            test::startFrom(simulation, [shape](GroupState& start) {
                const glm::vec3 first = start.positions[0];
                for (size_t i = 0; i < 4; ++i) {
                    if (shape == 0) start.positions[i] = first;
                    if (shape == 1) start.positions[i] = first + glm::vec3(0.3f * float(i), 0, 0);
                }
                if (shape == 2) start.positions[2] = start.positions[1];
            });
            for (int i = 0; i < 60; ++i) {
                test::runChecked(simulation, 1);
                const Snapshot now = simulation.snapshot(0);
                judge.finite(now);
                for (const glm::vec3& n : now.normals)
                    judge.near("normal", glm::length(n), 1, 1e-5);
            }
        });
    }
}

}  // namespace shoal
