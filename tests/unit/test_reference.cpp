// The double-precision reference against closed forms and invariants. Its own discretisation errors are
// stated where a tolerance needs one; everything else is rounding.
#include <cmath>
#include <numbers>

#include "molecule/skin.h"
#include "reference/discrete.h"
#include "reference/fields.h"
#include "reference/noise.h"
#include "reference/solve.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/colliders.h"
#include "support/every_kind.h"
#include "support/shapes.h"

namespace shoal::reference {

using std::numbers::pi;

TEST_CASE("a two-mass oscillator follows cos(wt)", "[reference]") {
    const Molecule molecule = test::pair(1, 0.5, 80, 0);
    const Problem problem{.molecule = &molecule};
    State start = restState(problem);
    start.position[1].x += 0.1;
    const double reduced = 1 * 0.5 / 1.5, omega = std::sqrt(80 / reduced), time = 2;
    const Solution solution = solve(problem, start, time, 1e-9);
    REQUIRE(solution.converged);
    const double length = solution.state.position[1].x - solution.state.position[0].x;
    CHECK(length == Approx(1 + 0.1 * std::cos(omega * time)).margin(1e-9));
    CHECK(glm::length(momentum(problem, solution.state)) < 1e-12);
}

TEST_CASE("a damped spring follows its closed form", "[reference]") {
    const double c = 0.8, k = 40, mass = 2;
    Molecule molecule = test::pair(1, mass, k, c);
    molecule.vertices[0].pinned = true;
    const Problem problem{.molecule = &molecule};
    State start = restState(problem);
    start.position[1].x += 0.2;
    const double decay = c / (2 * mass), omega = std::sqrt(k / mass - decay * decay), time = 3;
    const Solution solution = solve(problem, start, time, 1e-9);
    REQUIRE(solution.converged);
    const double expected =
        0.2 * std::exp(-decay * time) * (std::cos(omega * time) + decay / omega * std::sin(omega * time));
    CHECK(solution.state.position[1].x - 1 == Approx(expected).margin(1e-9));
    CHECK(solution.state.position[0] == start.position[0]);
}

TEST_CASE("a pinned vertex stands still and is given back its velocity", "[reference]") {
    Molecule molecule = test::pair(1, 1, 40, 1);
    molecule.vertices[0].pinned = true;
    Problem problem{.molecule = &molecule};
    if (GENERATE(false, true)) problem.colliders = {test::collider(test::plane({0, 0, 1}), 0, 0, 0)};
    State start = restState(problem);
    for (glm::dvec3& position : start.position)
        position.z += 1;  // above the plane
    start.velocity[0] = {3, 0, 0};
    const State end = integrate(problem, start, 0.1, 10);
    CHECK(end.position[0] == start.position[0]);
    CHECK(end.velocity[0] == start.velocity[0]);
}

TEST_CASE("the factors of a problem act on springs", "[reference]") {
    const Molecule molecule = test::pair(1, 1, 30, 0.5);
    const Problem doubled{.molecule = &molecule, .scale = 2, .stiffness = 3, .damping = 5};
    Vectors position{{0, 0, 0}, {2.5, 0, 0}}, velocity{{0, 0, 0}, {0.2, 0, 0}};
    const Vectors a = springAcceleration(doubled, position, velocity, 0);
    CHECK(a[0].x == Approx(90 * 0.5 + 2.5 * 0.2));
    CHECK(a[1].x == Approx(-a[0].x));
    CHECK(springEnergy(doubled, {0, position, velocity}) == Approx(0.5 * 90 * 0.25));
}

TEST_CASE("a muscle changes its rest length", "[reference]") {
    Molecule molecule = test::pair(1, 1, 10, 0);
    molecule.springs[0].actuation = Actuation{0.3, 2, 0.4};
    const Problem problem{.molecule = &molecule, .phase = 0.25};
    const State rest = restState(problem);
    const double time = 0.37;
    const double stretch = 1 - (1 + 0.3 * std::sin(2 * pi * 2 * time + 0.4 + 0.25));
    CHECK(springAcceleration(problem, rest.position, rest.velocity, time)[0].x == Approx(10 * stretch));
}

TEST_CASE("free fall with Stokes drag follows its closed form", "[reference]") {
    const Molecule molecule = test::point(3);
    for (double rate : {0.0, 0.02, 1.0, 30.0}) {
        Problem problem{.molecule = &molecule, .gravity = {0.5, -9.81, 0}, .drag = {rate, rate}};
        const glm::dvec3 wind{2, 0.3, -1}, v0{1, 4, 0};
        if (rate > 0) problem.fields.push_back(test::field(UniformField{wind}));
        const State start = restState(problem, {.position = {1, 2, 3}}, v0);
        const double t = 1.5;
        const Solution solution = solve(problem, start, t, 1e-12);
        REQUIRE(solution.converged);
        glm::dvec3 x = start.position[0] + v0 * t + 0.5 * problem.gravity * t * t;
        if (rate > 0) {
            const glm::dvec3 terminal = wind + problem.gravity / rate;
            x = start.position[0] + terminal * t + (v0 - terminal) * (1 - std::exp(-rate * t)) / rate;
        }
        CHECK(glm::length(solution.state.position[0] - x) < 1e-10);
    }
}

TEST_CASE("an oscillating wind drives what it drags, at a lag", "[reference]") {
    const Molecule molecule = test::point(3);
    for (double frequency : {0.5, 8.0, 1024.0}) {  // the last: the same at all times of long steps
        const double rate = 2, omega = 2 * pi * frequency, phase = 0.4, t = 1;
        Problem problem{.molecule = &molecule, .drag = {rate, rate}};
        const glm::dvec3 peak{3, 0, -1};
        problem.fields.push_back(test::field(OscillatingField{peak, frequency, phase}));
        const Solution solution = solve(problem, restState(problem), t, 1e-9);
        REQUIRE(solution.converged);
        const auto swing = [&](double angle) {
            return rate / (rate * rate + omega * omega) *
                   (rate * std::sin(angle + phase) - omega * std::cos(angle + phase));
        };
        const glm::dvec3 v = (swing(omega * t) - swing(0) * std::exp(-rate * t)) * peak;
        INFO("frequency " << frequency);
        CHECK(glm::length(solution.state.velocity[0] - v) < 1e-8);
    }
}

TEST_CASE("directional drag splits at the surface and equals plain drag for equal rates", "[reference]") {
    const Molecule molecule = test::leaf(0, 0);
    Problem problem{.molecule = &molecule, .drag = {9, 2}};
    problem.fields.push_back(test::field(UniformField{{1, 2, 3}}));
    const State state = restState(problem, {.rotation = test::turned()}, {0.2, 0, 0}, {1, 0, 2});
    const Vectors a = acceleration(problem, state), n = vertexNormals(*problem.molecule, state.position);
    for (size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 slip = glm::dvec3(1, 2, 3) - state.velocity[i];
        CHECK(glm::length(n[i]) == Approx(1));
        CHECK(glm::dot(a[i], n[i]) == Approx(9 * glm::dot(slip, n[i])));
        CHECK(glm::length(glm::cross(a[i], n[i]) - 2.0 * glm::cross(slip, n[i])) < 1e-12);
    }
    const State start = state;
    Problem nearly = problem, plain = problem;
    nearly.drag = {2, 2 * (1 + 1e-15)};
    plain.drag = {2, 2};
    REQUIRE(nearly.drag.directional());
    for (SolverKind kind : {SolverKind::euler, SolverKind::leapfrog}) {
        State a1 = start, a2 = start;
        frame(nearly, a1, kind, 0.5, 20);
        frame(plain, a2, kind, 0.5, 20);
        CHECK(relativeError(a1, a2, 1) < 1e-13);
    }
}

TEST_CASE("undamped motion keeps energy and momentum, rigid spin keeps the shape", "[reference]") {
    Molecule molecule = test::leaf(1e3, 0);
    const Problem problem{.molecule = &molecule};
    State start = restState(problem, {}, {0.3, 0, -0.2}, {2, 1, 3});
    start.position[2] += glm::dvec3(0.03, -0.02, 0.05);
    const Solution solution = solve(problem, start, 2, 1e-8);
    REQUIRE(solution.converged);
    CHECK(energy(problem, solution.state) == Approx(energy(problem, start)).epsilon(1e-8));
    CHECK(glm::length(momentum(problem, solution.state) - momentum(problem, start)) < 1e-11);
    CHECK(glm::length(angularMomentum(problem, solution.state) - angularMomentum(problem, start)) < 1e-8);

    // two masses on circles: the spring carries m w^2 r, so that the length for it is known
    const Molecule two = test::pair(1, 1, 500, 0);
    const Problem spinning{.molecule = &two};
    const double omega = 3, length = 500.0 / (500 - omega * omega / 2);
    State circle = restState(spinning);
    circle.position = {{-length / 2, 0, 0}, {length / 2, 0, 0}};
    circle.velocity = {{0, -omega * length / 2, 0}, {0, omega * length / 2, 0}};
    const Solution turned = solve(spinning, circle, 20, 1e-8);
    REQUIRE(turned.converged);
    const glm::dvec3 expected = length / 2 * glm::dvec3(std::cos(omega * 20), std::sin(omega * 20), 0);
    CHECK(glm::length(turned.state.position[1] - expected) < 1e-7);
}

TEST_CASE("the rest shape moved rigidly feels no force", "[reference]") {
    const Molecule molecule = test::leaf(1e4, 3);
    const Problem problem{.molecule = &molecule, .scale = 1.7};
    const State state = restState(problem, {{3, -8, 5}, test::turned(), 1.7, 0}, {4, 5, 6});
    for (const glm::dvec3& a : acceleration(problem, state))
        CHECK(glm::length(a) < 1e-14 * 1e4 * 1.7 * 20);
    // rotating rigidly, damping along the springs stays silent too
    const State spin = restState(problem, {{3, -8, 5}, test::turned(), 1.7, 0}, {}, {1, -2, 3});
    for (const glm::dvec3& a : acceleration(problem, spin))
        CHECK(glm::length(a) < 1e-14 * 1e4 * 1.7 * 20);
}

TEST_CASE("coincident, collinear and degenerate molecules stay finite", "[reference]") {
    Molecule molecule = test::leaf(1e3, 1);
    const Problem problem{.molecule = &molecule, .gravity = {0, -9.81, 0}, .drag = {8, 1}};
    for (int kind = 0; kind < 2; ++kind) {
        State state = restState(problem);
        for (size_t i = 0; i < 4; ++i)
            state.position[i] = {kind == 0 ? 0.0 : double(i), 0, 0};
        frame(problem, state, SolverKind::leapfrog, 0.1, 100);
        for (const glm::dvec3& x : state.position) {
            CHECK(std::isfinite(x.x + x.y + x.z));
        }
    }
}

// Slopes of log error against log step for one problem whose motion is smooth.
static double slope(const Problem& problem, const State& start, SolverKind kind, double time, int steps) {
    const Solution exact = solve(problem, start, time, 1e-9);
    REQUIRE(exact.converged);
    State coarse = start, fine = start;
    frame(problem, coarse, kind, time, steps);
    frame(problem, fine, kind, time, 2 * steps);
    return std::log2(relativeError(coarse, exact.state, 1) / relativeError(fine, exact.state, 1));
}

TEST_CASE("orders in a smooth scene: Runge-Kutta 4, euler 1, leapfrog 2", "[reference]") {
    const Molecule molecule = test::leaf(100, 0.5);
    const Problem problem = test::fallInShear(molecule);
    const State start = test::fallInShearStart(problem);

    const Solution exact = solve(problem, start, 1, 1e-11);
    REQUIRE(exact.converged);
    const double error100 = relativeError(integrate(problem, start, 1, 100), exact.state, 1);
    const double error200 = relativeError(integrate(problem, start, 1, 200), exact.state, 1);
    CHECK(std::log2(error100 / error200) == Approx(4).margin(0.15));

    CHECK(slope(problem, start, SolverKind::euler, 1, 2000) == Approx(1).margin(0.1));
    CHECK(slope(problem, start, SolverKind::leapfrog, 1, 500) == Approx(2).margin(0.1));

    Problem flat = problem;  // the same with the flat of the leaf dragging more
    flat.drag = {4, 0.5};
    CHECK(slope(flat, start, SolverKind::euler, 1, 2000) == Approx(1).margin(0.1));
    CHECK(slope(flat, start, SolverKind::leapfrog, 1, 500) == Approx(2).margin(0.1));
}

TEST_CASE("orders where time acts: a gust that travels and a muscle", "[reference]") {
    Molecule molecule = test::leaf(100, 0.5);
    molecule.vertices[0].pinned = true;
    for (Spring& spring : molecule.springs)
        spring.actuation = Actuation{0.1, 1.5, 0.5};
    Problem problem{.molecule = &molecule, .gravity = {0, -9.81, 0}, .drag = {3, 3}};
    GustField gust;
    gust.frontSpeed = 20;
    gust.length = 4;
    gust.noise = NoiseForm::computed;  // a table's slopes jump from value to value, which costs order
    problem.fields.push_back(test::field(gust));
    const State start = restState(problem, {.rotation = test::turned()});
    CHECK(slope(problem, start, SolverKind::euler, 1, 2000) == Approx(1).margin(0.1));
    CHECK(slope(problem, start, SolverKind::leapfrog, 1, 500) == Approx(2).margin(0.1));
}

TEST_CASE("deviation splits into centroid and shape", "[reference]") {
    State a, b;
    a.position = {{0, 0, 0}, {1, 0, 0}};
    b.position = {{0, 3, 0}, {1, 3, 0}};
    CHECK(deviation(b, a, 2).total == Approx(1.5));
    CHECK(deviation(b, a, 2).centroid == Approx(1.5));
    CHECK(deviation(b, a, 2).shape == Approx(0).margin(1e-15));
    b.position = {{-0.5, 0, 0}, {1.5, 0, 0}};
    CHECK(deviation(b, a, 1).centroid == Approx(0).margin(1e-15));
    CHECK(deviation(b, a, 1).shape == Approx(0.5));
}

TEST_CASE("what does not settle is called so", "[reference]") {
    const Molecule molecule = test::leaf(100, 0.5);
    const Problem problem = test::fallInShear(molecule);
    const Solution rough = solve(problem, test::fallInShearStart(problem), 1, 1e-15, 2);
    CHECK_FALSE(rough.converged);
    CHECK(rough.error > 1e-15);
}

}  // namespace shoal::reference
