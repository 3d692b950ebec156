// Judges the double-precision reference itself by motions that have closed forms, to 1e-10. Contact has its
// own in test_reference_contact.cpp.
#include <cmath>
#include <numbers>

#include "reference/solve.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace shoal::reference {

using glm::dvec3;
using std::numbers::pi;

namespace {

constexpr double near = 1e-10, g = 9.81;

// Jacobi's elliptic functions of a modulus k, by the arithmetic-geometric mean [Abramowitz 1964, 16.4].
struct Elliptic {
    double sn, cn, dn;
};
Elliptic elliptic(double u, double k) {
    double a[16] = {1}, c[16] = {k}, b = std::sqrt(1 - k * k);
    int n = 0;
    for (; std::abs(c[n]) > 1e-17 && n < 15; ++n) {
        a[n + 1] = (a[n] + b) / 2;
        c[n + 1] = (a[n] - b) / 2;
        b = std::sqrt(a[n] * b);
    }
    double angle = std::ldexp(a[n] * u, n);
    for (; n > 0; --n)
        angle = (angle + std::asin(c[n] / a[n] * std::sin(angle))) / 2;
    return {std::sin(angle), std::cos(angle), std::sqrt(1 - k * k * std::sin(angle) * std::sin(angle))};
}

// What of a motion would be left if springs were rigid, from three stiffnesses, each twice the one before:
// its first two powers of 1 / stiffness cancel.
template <typename Motion>
auto rigidLimit(double stiffness, const Motion& motion) {
    const auto a = motion(stiffness), b = motion(2 * stiffness), c = motion(4 * stiffness);
    return (8.0 * c - 6.0 * b + a) / 3.0;
}

// How far forces move the vertices of a molecule at rest, by conjugate gradients.
Vectors stretchOf(const Molecule& molecule, const Vectors& forces) {
    const auto dotOf = [](const Vectors& a, const Vectors& b) {
        double sum = 0;
        for (size_t i = 0; i < a.size(); ++i)
            sum += glm::dot(a[i], b[i]);
        return sum;
    };
    Vectors out(forces.size(), dvec3(0)), rest = forces, along = forces;
    for (int i = 0; i < 60 && dotOf(rest, rest) > 1e-30; ++i) {
        Vectors pulled(forces.size(), dvec3(0));
        for (const Spring& spring : molecule.springs) {
            const auto a = size_t(spring.a), b = size_t(spring.b);
            const dvec3 line = glm::normalize(molecule.vertices[b].position - molecule.vertices[a].position);
            const dvec3 pull = spring.stiffness * glm::dot(along[a] - along[b], line) * line;
            pulled[a] += pull;
            pulled[b] -= pull;
        }
        const double before = dotOf(rest, rest), step = before / dotOf(along, pulled);
        for (size_t v = 0; v < out.size(); ++v) {
            out[v] += step * along[v];
            rest[v] -= step * pulled[v];
        }
        const double kept = dotOf(rest, rest) / before;
        for (size_t v = 0; v < out.size(); ++v)
            along[v] = rest[v] + kept * along[v];
    }
    return out;
}

}  // namespace

TEST_CASE("damped modes of a chain decay as their closed form says", "[reference][closed-form]") {
    // Along a line springs are linear. Equal masses between equal springs with damping in proportion have the
    // modes sin(pi j k / 4), pinned at both ends.
    constexpr double mass = 0.5, k = 30, c = 0.4, time = 2;
    Molecule molecule;
    for (int i = 0; i < 5; ++i)
        molecule.vertices.push_back({.position = {i, 0, 0}, .mass = mass, .pinned = i == 0 || i == 4});
    for (int i = 0; i < 4; ++i)
        molecule.springs.push_back({i, i + 1, k, c, {}, {}});
    const Problem problem{.molecule = &molecule};
    State start = restState(problem);
    const double amplitudes[] = {0.1, -0.07, 0.05};
    const auto shape = [](int mode, int vertex) { return std::sin(pi * mode * vertex / 4); };
    for (int vertex = 1; vertex < 4; ++vertex)
        for (int mode = 1; mode < 4; ++mode)
            start.position[size_t(vertex)].x += amplitudes[mode - 1] * shape(mode, vertex);
    const Solution solution = solve(problem, start, time, 1e-12);
    REQUIRE(solution.converged);
    for (int vertex = 1; vertex < 4; ++vertex) {
        double expected = vertex;
        for (int mode = 1; mode < 4; ++mode) {
            const double bend = 4 * std::pow(std::sin(pi * mode / 8), 2);
            const double decay = c * bend / (2 * mass);
            const double omega = std::sqrt(k * bend / mass - decay * decay);
            expected += amplitudes[mode - 1] * shape(mode, vertex) * std::exp(-decay * time) *
                        (std::cos(omega * time) + decay / omega * std::sin(omega * time));
        }
        CHECK(solution.state.position[size_t(vertex)].x == Approx(expected).margin(near));
    }
}

TEST_CASE("a bar that is pinned at one end swings as a pendulum does", "[reference][closed-form]") {
    constexpr double mass = 2, angle = 1.2, time = 1.3;
    const dvec3 end = rigidLimit(2e7, [&](double stiffness) {
        Molecule molecule = test::pair(1, mass, stiffness, 0);
        molecule.vertices[0].pinned = true;
        const Problem problem{.molecule = &molecule, .gravity = {0, -g, 0}};
        State start = restState(problem);
        // let go where its spring carries it, so that it does not ring
        const double length = 1 + mass * g * std::cos(angle) / stiffness;
        start.position[1] = length * dvec3(std::sin(angle), -std::cos(angle), 0);
        return integrate(problem, start, time, 40000).position[1];
    });
    // sin(angle / 2) = k sn(K - sqrt(g / l) t), and sn(K - u) = cn u / dn u
    const double k = std::sin(angle / 2);
    const Elliptic e = elliptic(std::sqrt(g) * time, k);
    const double now = 2 * std::asin(k * e.cn / e.dn);
    CHECK(glm::length(end - dvec3(std::sin(now), -std::cos(now), 0)) < near);
}

TEST_CASE("a free asymmetric top turns as Euler's equations say", "[reference][closed-form]") {
    // Masses of 1 kg on three axes, each pair of them joined.
    const dvec3 arms(1.0, 0.8, 0.5);  // m
    const dvec3 squares = arms * arms;
    const dvec3 inertia = 2.0 * dvec3(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
    const dvec3 spin(0.5, 0, 0.9);  // rad/s
    constexpr double time = 4;
    const auto places = [&] {
        std::vector<dvec3> out;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {1.0, -1.0}) {
                dvec3 place(0);
                place[axis] = side * arms[axis];
                out.push_back(place);
            }
        return out;
    }();
    const dvec3 gained = -glm::cross(spin, inertia * spin) / inertia;  // angular acceleration
    const dvec3 end = rigidLimit(1e6, [&](double stiffness) {
        Molecule molecule;
        for (const dvec3& place : places)
            molecule.vertices.push_back({.position = place, .mass = 1});
        for (int a = 0; a < 6; ++a)
            for (int b = a + 1; b < 6; ++b)
                molecule.springs.push_back({a, b, stiffness, 0, {}, {}});
        const Problem problem{.molecule = &molecule};
        Vectors load;
        for (const dvec3& place : places)
            load.push_back(-glm::cross(gained, place) - glm::cross(spin, glm::cross(spin, place)));
        // begins as stretched as the spin keeps it, so that it does not ring
        const Vectors stretch = stretchOf(molecule, load);
        State start = restState(problem);
        for (size_t v = 0; v < 6; ++v) {
            start.position[v] += stretch[v];
            start.velocity[v] = glm::cross(spin, start.position[v]);
        }
        const State last = integrate(problem, start, time, 60000);
        // the spin in the directions of the top, of which angular momentum is known
        dvec3 axes[3];
        for (size_t axis = 0; axis < 3; ++axis)
            axes[axis] = glm::normalize(last.position[2 * axis] - last.position[2 * axis + 1]);
        const dvec3 momentum = angularMomentum(problem, last);
        return dvec3(glm::dot(axes[0], momentum), glm::dot(axes[1], momentum), glm::dot(axes[2], momentum)) /
               inertia;
    });
    // [Landau 1976, 37], with moments in this order, from a spin without its middle part
    const double twice = glm::dot(inertia, spin * spin), square = glm::dot(inertia * spin, inertia * spin);
    const double slow = twice * inertia.z - square, fast = square - twice * inertia.x;
    const double rate = std::sqrt((inertia.z - inertia.y) * fast / (inertia.x * inertia.y * inertia.z));
    const Elliptic e =
        elliptic(rate * time, std::sqrt((inertia.y - inertia.x) * slow / ((inertia.z - inertia.y) * fast)));
    const dvec3 expected(std::sqrt(slow / (inertia.x * (inertia.z - inertia.x))) * e.cn,
                         std::sqrt(slow / (inertia.y * (inertia.z - inertia.y))) * e.sn,
                         std::sqrt(fast / (inertia.z * (inertia.z - inertia.x))) * e.dn);
    CHECK(glm::length(end - expected) < near);
}

}  // namespace shoal::reference
