// Contact of molecules with one another. On the ping-pong path nothing of this runs that needs the fused one.
#include <algorithm>
#include <cmath>

#include "hard/outcome.h"
#include "molecule/molecule_file.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

constexpr double g = 9.81;
constexpr double pileRadius = 0.14;  // m

Group marbles(const std::vector<glm::dvec3>& places, double radius, double mass, const glm::dvec3& velocity,
              double restitution) {
    std::vector<test::Item> items;
    for (const glm::dvec3& place : places)
        items.push_back(at(place));
    Group out = test::sceneOf(test::point(mass), SolverKind::leapfrog, items).groups[0];
    out.velocity = velocity;
    out.restitution = restitution;
    out.friction = 0;
    out.contact.emplace().radius = radius;
    return out;
}

Scene sceneOf(const Solver& solver, std::vector<Group> groups) {
    Scene scene;
    scene.name = "marbles";
    scene.solver.kind = solver.kind;
    scene.groups = std::move(groups);
    for (size_t i = 0; i < scene.groups.size(); ++i)
        scene.groups[i].name = concat("marbles ", i);
    return scene;
}

// One marble at rest of mass 2, one of mass 1 that flies at it, `aside` of the middle, from 16 distances, so
// that they meet in 16 phases of a step.
void meet(const Solver& solver, Judge& judge, double aside, double restitution, double speed = 3) {
    constexpr double radius = 0.05, m = 1, n = 2;
    const double h = 1 / 240.0;
    std::vector<glm::dvec3> resting, flying;
    for (int phase = 0; phase < 16; ++phase) {
        const double row = phase * speed / 3;  // none meets another
        resting.emplace_back(0, row, 0);
        flying.emplace_back(-0.1 * speed - phase / 16.0 * speed * h, row + aside, 0);
    }
    Scene scene = sceneOf(solver, {marbles(resting, radius, n, {0, 0, 0}, restitution),
                                   marbles(flying, radius, m, {speed, 0, 0}, restitution)});
    if (speed * h > 2 * radius) scene.contact.fastest = speed;
    setSteps(scene, h, 1);
    Simulation simulation = test::hardSimulation(scene);
    test::runChecked(simulation, 60);
    const Snapshot a = simulation.snapshot(0), b = simulation.snapshot(1);
    const double sine = aside / (2 * radius), cosine = std::sqrt(1 - sine * sine);
    const glm::dvec3 normal{-cosine, sine, 0};  // from the one at rest to the other
    const glm::dvec3 impulse = normal * ((1 + restitution) * speed * cosine * m * n / (m + n));
    for (size_t phase = 0; phase < 16; ++phase) {
        const double meets = (-flying[phase].x - 2 * radius * cosine) / speed, after = 60 * h - meets;
        const glm::dvec3 v = glm::dvec3(speed, 0, 0) + impulse / m, w = -impulse / n;
        const glm::dvec3 x = flying[phase] + glm::dvec3(speed, 0, 0) * meets + v * after;
        judge.atMost("velocity / speed", glm::distance(b.velocities[phase], v) / speed, 2e-5);
        judge.atMost("velocity / speed", glm::distance(a.velocities[phase], w) / speed, 2e-5);
        judge.atMost("way m", glm::distance(b.positions[phase], x), 5e-5);
        judge.atMost("way m", glm::distance(a.positions[phase], resting[phase] + w * after), 5e-5);
    }
}

Collider wall(const glm::dvec3& point, const glm::dvec3& normal, double thickness) {
    PlaneCollider plane;
    plane.point = point;
    plane.normal = normal;
    Collider out;
    out.shape = plane;
    out.thickness = thickness;
    return out;
}

// Furthest that a vertex has moved between two states of a group.
double moved(const Snapshot& a, const Snapshot& b) {
    double out = 0;
    for (size_t i = 0; i < a.positions.size(); ++i)
        out = std::max(out, glm::distance(a.positions[i], b.positions[i]));
    return out;
}

// Runs so many frames; returns the greatest speed of a vertex of the first group after any, m/s.
double fastestOf(Simulation& simulation, int frames) {
    double out = 0;
    for (int i = 0; i < frames; ++i) {
        test::runChecked(simulation, 1);
        for (const glm::dvec3& v : simulation.snapshot(0).velocities)
            out = std::max(out, glm::length(v));
    }
    return out;
}

double deepest(const Simulation& simulation, const Snapshot& now, double radius) {
    double out = 0;
    for (const auto& [a, b] : simulation.contact()->found())
        out = std::max(out, 2 * radius - glm::distance(now.positions[size_t(a)], now.positions[size_t(b)]));
    return out;
}

// 48 tetrahedra poured into a square well.
Scene pile(const Solver& solver) {
    constexpr double well = 1.1;
    Scene scene = test::sceneOf(test::tetrahedron(2e3, 20), solver.kind);
    Group& group = scene.groups[0];
    group.count = 48;
    group.place.kind = Placement::Kind::grid;
    group.place.items.clear();
    group.place.origin = {-0.35, 0.2, -0.35};
    group.place.spacing = {0.7, 0.55, 0.7};
    group.place.cells = {2, 12, 2};
    group.place.turn = Placement::Turn::any;
    group.drag = {0.5, 0.5};
    group.contact.emplace().radius = pileRadius;
    scene.gravity = {0, -g, 0};
    scene.colliders = {wall({0, 0, 0}, {0, 1, 0}, pileRadius)};
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
        scene.colliders.push_back(wall(-well * side, side, pileRadius));
        scene.colliders.push_back(wall(well * side, -side, pileRadius));
    }
    scene.contact.iterations = 8;
    setSteps(scene, 1 / 60.0, 8);
    return scene;
}

// Judges how far, in radii, a vertex of the pile moves in the second after so many.
void judgeRest(const Scene& scene, Judge& judge, int seconds, double most) {
    Simulation simulation = test::hardSimulation(scene);
    test::runChecked(simulation, 60 * seconds);
    const Snapshot rested = simulation.snapshot(0);
    test::runChecked(simulation, 60);
    const Snapshot later = simulation.snapshot(0);
    judge.finite(later);
    judge.atMost("moved / radius", moved(rested, later) / pileRadius, most);
    judge.atMost("deepest / radius", deepest(simulation, later, pileRadius) / pileRadius, 0.5);
    judge.atMost("dropped", simulation.contact()->dropped(), 0);
}

Scene leaves(const Solver& solver, uint64_t seed) {
    Scene scene = test::sceneOf(readMolecule(SHOAL_SOURCE_DIR "/molecules/leaf.json"), solver.kind);
    scene.seed = seed;
    Group& group = scene.groups[0];
    group.count = 30;
    group.place.kind = Placement::Kind::volume;
    group.place.items.clear();
    group.place.box = {{-0.06, 0.05, -0.06}, {0.06, 0.6, 0.06}};
    group.place.turn = Placement::Turn::any;
    group.place.scale = {2, 2.6};
    group.held = false;
    group.drag = {9, 0.9};
    group.friction = 0.2;
    group.restitution = 0;
    group.contact.emplace().radius = 0.008;
    scene.gravity = {0, -g, 0};
    scene.colliders = {wall({0, 0, 0}, {0, 1, 0}, 0)};
    scene.colliders[0].friction = 0.2;
    setSteps(scene, 1 / 60.0, 4);
    return scene;
}

}  // namespace

TEST_CASE("hard: two marbles meet", "[hard][molecule contact][fused]") {
    for (const double e : {0.0, 0.5, 1.0}) {
        test::holds(concat("head-on pair, restitution ", e),
                    [&](const Solver& solver, Judge& judge) { meet(solver, judge, 0, e); });
        test::holds(concat("glancing pair, restitution ", e),
                    [&](const Solver& solver, Judge& judge) { meet(solver, judge, 0.09, e); });
    }
    // 0.33 m a step, of 0.1 m that both are wide
    test::holds("fast pair, head-on",
                [](const Solver& solver, Judge& judge) { meet(solver, judge, 0, 0.5, 80); });
    test::holds("fast pair, glancing",
                [](const Solver& solver, Judge& judge) { meet(solver, judge, 0.09, 0.5, 80); });
}

// Leaves fly at one another face to face at 5 m/s, 21 mm in a step, in 16 phases of it.
TEST_CASE("hard: fast leaves", "[hard][molecule contact][fused]") {
    test::holds("leaves meet at 5 m/s", [](const Solver& solver, Judge& judge) {
        constexpr double speed = 5, h = 1 / 240.0;
        std::vector<test::Item> here, there;
        for (int phase = 0; phase < 16; ++phase) {
            here.push_back(at({0.2 * phase, 0, 0}));
            there.push_back(at({0.2 * phase, 0, 0.3 + phase / 16.0 * speed * h}));
        }
        const Molecule leaf = readMolecule(SHOAL_SOURCE_DIR "/molecules/leaf.json");
        Scene scene = test::sceneOf(leaf, solver.kind, here);
        scene.groups.push_back(test::sceneOf(leaf, solver.kind, there).groups[0]);
        for (size_t g = 0; g < 2; ++g) {
            Group& group = scene.groups[g];
            group.name = concat("leaves ", g);
            group.velocity = {0, 0, g == 0 ? speed / 2 : -speed / 2};
            group.held = false;
            group.contact.emplace().radius = 0.002;
            group.contact->triangles = true;
        }
        scene.contact.fastest = speed;
        setSteps(scene, h, 1);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 48);
        const Snapshot a = simulation.snapshot(0), b = simulation.snapshot(1);
        judge.finite(a);
        judge.finite(b);
        const size_t vertices = leaf.vertices.size();
        int through = 0;
        for (size_t m = 0; m < 16; ++m) {
            double ahead = 0;
            for (size_t i = m * vertices; i < (m + 1) * vertices; ++i)
                ahead += a.positions[i].z - b.positions[i].z;
            through += ahead > 0;
        }
        judge.atMost("leaves through", through, 0);
    });
}

TEST_CASE("hard: a pile of molecules", "[hard][molecule contact][fused]") {
    test::holds("a pile of tetrahedra comes to rest and stays",
                [](const Solver& solver, Judge& judge) { judgeRest(pile(solver), judge, 4, 0.05); });
    test::holds("a pile of tetrahedra with `rest` stays to the bit", [](const Solver& solver, Judge& judge) {
        Scene scene = pile(solver);
        scene.contact.rest = 0.005;
        judgeRest(scene, judge, 9, 0);
    });
}

// 30 leaves that fall from a column onto a floor.
TEST_CASE("hard: a heap of leaves", "[hard][molecule contact][fused]") {
    test::holds("three heaps of leaves with `rest` are no livelier than without", [](const Solver& solver,
                                                                                     Judge& judge) {
        for (const uint64_t seed : {1, 2, 3}) {
            double speeds[2] = {};            // m/s, RMS of half a second: without, with
            std::vector<double> squares(30);  // of each leaf, without; one may still slip off another
            for (const bool rests : {false, true}) {
                Scene scene = leaves(solver, seed);
                if (rests) scene.contact.rest = 0.02;
                Simulation simulation = test::hardSimulation(scene);
                test::runChecked(simulation, 210);
                for (int i = 0; i < 6; ++i) {
                    test::runChecked(simulation, 5);
                    const Snapshot now = simulation.snapshot(0);
                    judge.finite(now);
                    const double share = 1 / (6.0 * double(now.velocities.size()));
                    for (size_t v = 0; v < now.velocities.size(); ++v) {
                        const double square = glm::dot(now.velocities[v], now.velocities[v]);
                        speeds[rests] += share * square;
                        if (!rests)
                            squares[v * squares.size() / now.velocities.size()] += 30 * share * square;
                    }
                }
                speeds[rests] = std::sqrt(speeds[rests]);
            }
            std::nth_element(squares.begin(), squares.begin() + 15, squares.end());
            judge.atMost("with `rest` - without, m/s", std::max(speeds[1] - speeds[0], 0.0), 1e-5);
            judge.atMost("median without, m/s", std::sqrt(squares[15]), 0.001);
        }
    });
}

// 27 tetrahedra that start with half the room that they need come apart slowly.
TEST_CASE("hard: squeezed molecules", "[hard][molecule contact][fused]") {
    test::holds("tetrahedra squeezed to half their room", [](const Solver& solver, Judge& judge) {
        constexpr double scale = 0.1, radius = 0.14, spacing = 0.44;
        Scene scene = test::sceneOf(test::tetrahedron(2e3, 20), solver.kind);
        Group& group = scene.groups[0];
        group.count = 27;
        group.place.kind = Placement::Kind::grid;
        group.place.items.clear();
        group.place.spacing = glm::dvec3(scale * spacing);
        group.place.scale = glm::dvec2(scale);
        group.place.cells = {3, 3, 3};
        group.place.turn = Placement::Turn::any;
        group.contact.emplace().radius = radius;
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        const double fastest = fastestOf(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        judge.finite(now);
        judge.atMost("fastest m/s", fastest, 2);
        judge.atMost("deepest / radius", deepest(simulation, now, scale * radius) / (scale * radius), 0.05);
        judge.atMost("dropped", simulation.contact()->dropped(), 0);
    });
}

// 75 marbles poured onto a slope, whose friction is that of 26.6 degrees.
TEST_CASE("hard: marbles on a slope", "[hard][molecule contact][fused]") {
    constexpr double radius = 0.05, friction = 0.5, h = 1 / 240.0;
    const auto slope = [](const Solver& solver, double angle) {
        Scene scene = sceneOf(solver, {marbles({}, radius, 0.1, {0, 0, 0}, 0)});
        Group& group = scene.groups[0];
        group.count = 75;
        group.friction = friction;
        group.place.kind = Placement::Kind::grid;
        group.place.origin = {0, radius, 0};
        group.place.spacing = glm::dvec3(2.1 * radius);
        group.place.cells = {5, 3, 5};
        scene.gravity = g * glm::dvec3(std::sin(angle), -std::cos(angle), 0);
        scene.colliders = {wall({0, 0, 0}, {0, 1, 0}, radius)};
        setSteps(scene, 4 * h, 4);
        return scene;
    };
    test::holds("marbles on a slope of 20 degrees stay", [&](const Solver& solver, Judge& judge) {
        Simulation simulation = test::hardSimulation(slope(solver, glm::radians(20.0)));
        test::runChecked(simulation, 300);
        const Snapshot rested = simulation.snapshot(0);
        test::runChecked(simulation, 60);
        const Snapshot later = simulation.snapshot(0);
        judge.finite(later);
        judge.atMost("moved / radius", moved(rested, later) / radius, 0.05);
    });
    test::holds("marbles on a slope of 32 degrees slide", [&](const Solver& solver, Judge& judge) {
        const double angle = glm::radians(32.0);
        const auto speed = [](const Snapshot& now) {
            double sum = 0;
            for (const glm::dvec3& v : now.velocities)
                sum += v.x;
            return sum / double(now.velocities.size());
        };
        Simulation simulation = test::hardSimulation(slope(solver, angle));
        test::runChecked(simulation, 120);
        const double before = speed(simulation.snapshot(0));
        test::runChecked(simulation, 60);
        const Snapshot later = simulation.snapshot(0);
        judge.finite(later);
        const double expected = g * (std::sin(angle) - friction * std::cos(angle));
        judge.atMost("acceleration off", std::abs(speed(later) - before - expected) / expected, 0.05);
    });
}

// Two molecules that start inside one another part, slower than a fall of a metre.
TEST_CASE("hard: a molecule inside another", "[hard][molecule contact][fused]") {
    test::holds("a molecule starts inside another", [](const Solver& solver, Judge& judge) {
        constexpr double radius = 0.1;
        Scene scene = test::sceneOf(test::tetrahedron(500, 5), solver.kind,
                                    {at({0, 0, 0}), at({0.05, 0.02, 0.01}), at({3, 0, 0}), at({3, 0, 0})});
        scene.groups[0].contact.emplace().radius = radius;
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        const double fastest = fastestOf(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        judge.finite(now);
        judge.atMost("fastest m/s", fastest, 4.4);
        judge.atMost("deepest / radius", deepest(simulation, now, radius) / radius, 0.05);
    });
}

// A cube of marbles, each of which touches six: momentum and energy, and the same bits again.
TEST_CASE("hard: a million contacts", "[hard][molecule contact][fused][million]") {
    test::holds("a million contacts", [](const Solver& solver, Judge& judge) {
        constexpr int side = 70;
        constexpr double radius = 0.05;
        Scene scene = test::sceneOf(test::point(1), solver.kind);
        Group& group = scene.groups[0];
        group.count = side * side * side;
        group.place.kind = Placement::Kind::grid;
        group.place.items.clear();
        group.place.spacing = glm::dvec3(1.9 * radius);
        group.place.cells = glm::ivec3(side);
        group.place.turn = Placement::Turn::none;
        group.contact.emplace().radius = radius;
        setSteps(scene, 1 / 240.0, 1);
        uint64_t hash = 0;
        for (int repeat = 0; repeat < 2; ++repeat) {
            Simulation simulation = test::hardSimulation(scene);
            test::startFrom(simulation, [&](GroupState& state) {
                for (size_t i = 0; i < state.velocities.size(); ++i)
                    state.velocities[i] =
                        glm::vec3(float(i % 7) - 3, float(i % 11) - 5, float(i % 13) - 6) * 0.005f;
            });
            glm::dvec3 before(0), after(0);
            double scale = 0;
            for (const glm::dvec3& v : simulation.snapshot(0).velocities) {
                before += v;
                scale += glm::length(v);
            }
            test::runChecked(simulation, 1);
            if (repeat == 0) {
                judge.atMost("contacts missing",
                             3.0 * side * side * (side - 1) - double(simulation.contact()->found().size()),
                             0);
                judge.report("contacts", double(simulation.contact()->found().size()));
                judge.atMost("dropped", simulation.contact()->dropped(), 0);
            }
            for (const glm::dvec3& v : simulation.snapshot(0).velocities)
                after += v;
            judge.atMost("momentum", glm::length(after - before) / scale, 1e-5);
            judge.atMost("differs", repeat > 0 && simulation.hash() != hash ? 1 : 0, 0);
            hash = simulation.hash();
        }
    });
}

// A sphere without extent is no sphere; the smallest is one.
TEST_CASE("hard: the smallest radius", "[hard][molecule contact][fused]") {
    test::holds("contact of radius 1e-9 m", [](const Solver& solver, Judge& judge) {
        Scene scene = sceneOf(solver, {marbles({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 1e-9, 1, {1, 0, 0}, 0.5)});
        setSteps(scene, 1 / 60.0, 1);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 10);
        const Snapshot now = simulation.snapshot(0);
        judge.finite(now);
        judge.near("m", now.positions[2].x, 1 + 10 / 60.0, 1e-5);
    });
}

}  // namespace shoal
