// The reference's contact against closed forms. Between events Runge-Kutta is exact for a parabola, so that
// what is left of most of these is rounding.
#include <cmath>
#include <numbers>

#include "reference/contact.h"
#include "reference/solve.h"
#include "support/catch.h"
#include "support/colliders.h"
#include "support/shapes.h"

namespace shoal::reference {

namespace {

constexpr double g = 9.81, thickness = 0.01;
const glm::dvec3 down{0, -g, 0};

Collider collider(ColliderShape shape, double restitution, double friction) {
    return test::collider(std::move(shape), restitution, friction, thickness);
}

Collider floor(double restitution, double friction) {
    return collider(PlaneCollider{}, restitution, friction);
}

// A point of 2 kg under gravity.
struct Point {
    Molecule molecule = test::point(2);
    Problem problem{.molecule = &molecule, .gravity = down};

    explicit Point(Collider collider) { problem.colliders = {std::move(collider)}; }
    Point(const Point&) = delete;

    State after(const glm::dvec3& x, const glm::dvec3& v, double time) const {
        const Solution solution = solve(problem, {0, {x}, {v}}, time, 1e-10);
        REQUIRE(solution.converged);
        return solution.state;
    }
};

Collider slope(double angle, double friction) {
    return collider(PlaneCollider{{0, 0, 0}, {std::sin(angle), std::cos(angle), 0}}, 0.3, friction);
}

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST_CASE("reference: a bounce reaches e^2 of its height", "[reference][contact]") {
    const double fall = std::sqrt(2 * 1.3 / g);
    for (double e : {0.0, 0.3, 0.7, 1.0}) {
        const Point point(floor(e, 0.4));
        // without a rebound the apex is the impact itself: a little after it
        const State apex =
            point.after({0, 1.3 + thickness, 0}, {0, 0, 0}, fall * (1 + e) + (e == 0 ? 0.01 : 0));
        INFO("e " << e);
        CHECK(apex.position[0].y - thickness == Approx(e * e * 1.3).margin(1e-12));
        CHECK(std::abs(apex.velocity[0].y) < 1e-11);
    }
}

TEST_CASE("reference: many bounces keep their times, and end", "[reference][contact]") {
    const double e = 0.7, fall = std::sqrt(2 / g), speed = g * fall;
    const Point point(floor(e, 0));
    for (int bounces : {1, 2, 5, 12}) {
        double impact = fall;  // the time of the last of the bounces
        for (int i = 1; i < bounces; ++i)
            impact += 2 * fall * std::pow(e, i);
        const double left = speed * std::pow(e, bounces), later = 0.3 * 2 * left / g;
        const State state = point.after({0, 1 + thickness, 0}, {2, 0, 0}, impact + later);
        INFO(bounces << " bounces");
        CHECK(state.position[0].y - thickness == Approx(left * later - g / 2 * later * later).epsilon(1e-9));
        CHECK(state.velocity[0].y == Approx(left - g * later).epsilon(1e-9));
        CHECK(state.velocity[0].x == 2);
    }
    const double end = fall * (1 + e) / (1 - e);
    const State state = point.after({0, 1 + thickness, 0}, {2, 0, 0}, end + 1e-4);
    CHECK(state.position[0].y == thickness);
    CHECK(state.velocity[0] == glm::dvec3(2, 0, 0));
}

TEST_CASE("reference: friction takes mu times the normal change, and no more than there is",
          "[reference][contact]") {
    const double e = 0.5, mu = 0.3, fall = std::sqrt(2 / g), lost = mu * (1 + e) * g * fall;
    const Point point(floor(e, mu));
    const State slowed = point.after({0, 1 + thickness, 0}, {3, 0, -4}, fall * 1.1);
    CHECK(glm::length(slowed.velocity[0] * glm::dvec3(1, 0, 1)) == Approx(5 - lost).epsilon(1e-12));
    CHECK(slowed.velocity[0].x / slowed.velocity[0].z == Approx(-0.75).epsilon(1e-12));
    const State stopped = point.after({0, 1 + thickness, 0}, {0.6 * lost, 0, 0.7 * lost}, fall * 1.1);
    CHECK(stopped.velocity[0].x == 0);
    CHECK(stopped.velocity[0].z == 0);
}

TEST_CASE("reference: a slope slides at g (sin a - mu cos a) and holds below atan mu",
          "[reference][contact]") {
    const double mu = 0.5, time = 1.5;
    for (double degrees : {10.0, 20.0, 26.5, 26.6, 35.0, 60.0}) {
        const double a = degrees * degree;
        const glm::dvec3 along{std::cos(a), -std::sin(a), 0}, normal{std::sin(a), std::cos(a), 0};
        const Point point(slope(a, mu));
        const glm::dvec3 start = thickness * normal;
        const State state = point.after(start, {0, 0, 0}, time);
        const double rate = std::max(0.0, g * (std::sin(a) - mu * std::cos(a)));
        INFO("angle " << degrees);
        CHECK(glm::length(state.velocity[0] - rate * time * along) < 1e-10);
        CHECK(glm::length(state.position[0] - start - rate * time * time / 2 * along) < 1e-10);
        if (rate == 0) CHECK(state.position[0] == start);
    }
}

TEST_CASE("reference: what slides up a slope stops, and slides back or stays", "[reference][contact]") {
    for (double degrees : {0.0, 15.0, 40.0}) {
        const double a = degrees * degree, mu = 0.4, speed = 2, time = 1;
        const glm::dvec3 up{-std::cos(a), std::sin(a), 0}, normal{std::sin(a), std::cos(a), 0};
        const Point point(slope(a, mu));
        const State state = point.after(thickness * normal, speed * up, time);
        const double brake = g * (std::sin(a) + mu * std::cos(a)), stop = speed / brake;
        const double back = std::max(0.0, g * (std::sin(a) - mu * std::cos(a))), rest = time - stop;
        INFO("angle " << degrees);
        const glm::dvec3 expected =
            thickness * normal + (speed * speed / (2 * brake) - back * rest * rest / 2) * up;
        CHECK(glm::length(state.position[0] - expected) < 1e-10);
        CHECK(glm::length(state.velocity[0] + back * rest * up) < 1e-10);
        if (back == 0) CHECK(state.velocity[0] == glm::dvec3(0));
    }
}

// Across a slope friction turns the velocity down it: dv/dt = f - mu N v/|v| in the plane, whose solution
// with mu N = f keeps |v| + v along the slope.
TEST_CASE("reference: friction turns with the velocity", "[reference][contact]") {
    const double a = 30 * degree, mu = std::tan(a);
    const Point point(slope(a, mu));
    const glm::dvec3 along{std::cos(a), -std::sin(a), 0}, normal{std::sin(a), std::cos(a), 0};
    const State state = point.after(thickness * normal, {0, 0, 1}, 3);
    const glm::dvec3 v = state.velocity[0];
    CHECK(glm::length(v) + glm::dot(v, along) == Approx(1).epsilon(1e-8));
    CHECK(v.z > 0);
    CHECK(v.z < 0.01);  // nearly all down the slope, at half the speed
}

// With mu N = k f, k > 1: k |v| + v along the slope falls by (k^2 - 1) f a second until both are 0. With the
// angle t between v and the slope, v = v0 tan(t/2)^(k - 1) (1 + tan(t/2)^2) / 2, which gives the way.
TEST_CASE("reference: what slides across a rough slope turns down it as it stops", "[reference][contact]") {
    const double a = 30 * degree, k = 1.5, f = g * std::sin(a);
    const Point point(slope(a, k * std::tan(a)));
    const glm::dvec3 along{std::cos(a), -std::sin(a), 0}, normal{std::sin(a), std::cos(a), 0};
    const State start{0, {thickness * normal}, {{0, 0, 1}}};
    const double stop = k / ((k * k - 1) * f);
    CHECK(glm::length(integrate(point.problem, start, 0.99 * stop, 40).velocity[0]) > 0);
    const State end = integrate(point.problem, start, 1.01 * stop, 40);
    CHECK(end.velocity[0] == glm::dvec3(0));
    const glm::dvec3 way = end.position[0] - start.position[0];
    CHECK(glm::dot(way, along) == Approx(1 / (4 * f * (k * k - 1))).epsilon(1e-5));
    CHECK(way.z == Approx(2 * k / (f * (4 * k * k - 1))).epsilon(1e-5));
}

TEST_CASE("reference: a point thrown at a sphere", "[reference][contact]") {
    SphereCollider sphere;
    sphere.center = {1, 2, 3};
    sphere.radius = 0.5 - thickness;
    for (double mu : {0.0, 0.2}) {
        Point point(collider(sphere, 0.6, mu));
        point.problem.gravity = {};
        // along x, 0.3 m off the centre: it meets the surface 0.4 m before the centre
        const State state = point.after({-1, 2.3, 3}, {4, 0, 0}, 0.5);
        const glm::dvec3 n{-0.8, 0.6, 0}, t{0.6, 0.8, 0};
        const double vn = 3.2, vt = 2.4 - mu * 1.6 * vn;
        const glm::dvec3 v = 0.6 * vn * n + vt * t;
        CHECK(glm::length(state.velocity[0] - v) < 1e-10);
        const glm::dvec3 hit = sphere.center + 0.5 * n;
        CHECK(glm::length(state.position[0] - hit - (0.5 - 1.6 / 4) * v) < 1e-10);
    }
    // fast and small: within a step it is through
    sphere.radius = 0.05;
    Point fast(collider(sphere, 1, 0));
    fast.problem.gravity = {};
    const State state = fast.after({-19, 2, 3}, {200, 0, 0}, 0.2);
    CHECK(state.velocity[0].x == Approx(-200));
    CHECK(state.position[0].x == Approx(0.94 - (40 - 19.94)).epsilon(1e-12));
}

// The classical one: from the top it leaves where cos a = 2/3 + v^2 / 3gR, and keeps its speed along x.
TEST_CASE("reference: a point leaves a smooth sphere where it should", "[reference][contact]") {
    SphereCollider sphere;
    sphere.radius = 1 - thickness;
    const Point point(collider(sphere, 0, 0));
    const double speed = 0.5, cosine = 2 / 3.0 + speed * speed / (3 * g);
    const State riding = point.after({0, 1, 0}, {speed, 0, 0}, 0.4);
    CHECK(glm::length(riding.position[0]) == Approx(1).epsilon(1e-12));
    CHECK(glm::dot(riding.velocity[0], riding.velocity[0]) ==
          Approx(speed * speed + 2 * g * (1 - riding.position[0].y)).epsilon(1e-9));
    const State flying = point.after({0, 1, 0}, {speed, 0, 0}, 1.0);
    CHECK(glm::length(flying.position[0]) > 1.1);
    CHECK(flying.velocity[0].x == Approx(std::sqrt(g * cosine) * cosine).epsilon(1e-7));
    CHECK(flying.velocity[0].z == 0);
}

TEST_CASE("reference: a tilted height field is a plane", "[reference][contact]") {
    HeightFieldCollider field;
    field.columns = field.rows = 41;
    field.low = {-5, -5}, field.high = {5, 5};
    for (int z = 0; z < 41; ++z) {
        for (int x = 0; x < 41; ++x)
            field.heights.push_back(-0.75f * (0.25f * float(x) - 5));
    }
    const glm::dvec3 along{0.8, -0.6, 0}, normal{0.6, 0.8, 0};
    for (bool sampled : {false, true}) {
        field.sampledNormals = sampled;
        const Point point(collider(field, 0.5, 0.25));
        const glm::dvec3 start = thickness * normal - 2.0 * along;
        const State slid = point.after(start, {0, 0, 0}, 1);
        const double rate = g * (0.6 - 0.25 * 0.8);
        CHECK(glm::length(slid.position[0] - start - rate / 2 * along) < 1e-7);
        CHECK(glm::length(slid.velocity[0] - rate * along) < 1e-7);
        const State bounced = point.after(start + 0.5 * normal, -3.0 * normal, 0.2);
        const Point plane(collider(PlaneCollider{{0, 0, 0}, normal}, 0.5, 0.25));
        const State same = plane.after(start + 0.5 * normal, -3.0 * normal, 0.2);
        CHECK(glm::length(bounced.position[0] - same.position[0]) < 1e-7);
        // over the edge there is nothing
        CHECK(point.after({6, -3, 0}, {0, 0, 0}, 1).velocity[0].y == Approx(-g));
        CHECK(point.after(start + 6.5 * along, 3.0 * along, 1).position[0].y < -5);
    }
}

// Without gravity at 50 m/s over ridges: within a step it is past them.
TEST_CASE("reference: the first of many ridges is hit", "[reference][contact]") {
    HeightFieldCollider field;
    field.columns = 81, field.rows = 3;
    field.low = {0, -1}, field.high = {20, 1};
    for (int z = 0; z < 3; ++z) {
        for (int x = 0; x < 81; ++x)
            field.heights.push_back(x % 16 == 8 ? 1 : 0);  // at 2 m, 6 m ... with flanks of 0.25 m
    }
    Point point(collider(field, 0, 0));
    point.problem.gravity = {};
    const State state = integrate(point.problem, {0, {{-4, 0.6, 0}}, {{50, 0, 0}}}, 0.4, 2);
    CHECK(state.velocity[0].y > 5);
    CHECK(state.velocity[0].x < 45);
    // it follows the flank and leaves from its top
    CHECK(state.position[0].y > 1);
    const State before = integrate(point.problem, {0, {{-4, 0.6, 0}}, {{50, 0, 0}}}, 5.8 / 50, 2);
    CHECK(before.velocity[0].x == 50);
}

TEST_CASE("reference: vertices that hit within one step each keep their time", "[reference][contact]") {
    Molecule molecule = test::pair(1, 1, 0, 0);
    molecule.springs.clear();
    molecule.vertices.push_back(molecule.vertices[0]);
    const Problem problem{.molecule = &molecule, .gravity = down, .colliders = {floor(0.6, 0)}};
    const double heights[] = {0.9, 0.3, 0.6};
    State start = restState(problem);
    for (size_t i = 0; i < 3; ++i)
        start.position[i].y = heights[i] + thickness;
    const double time = 0.45;
    const State state = integrate(problem, start, time, 1);
    for (size_t i = 0; i < 3; ++i) {
        const double fall = std::sqrt(2 * heights[i] / g), since = time - fall, up = 0.6 * g * fall;
        CHECK(state.position[i].y - thickness == Approx(up * since - g / 2 * since * since).margin(1e-11));
    }
}

TEST_CASE("reference: rest stays exactly, on one surface and between two", "[reference][contact]") {
    for (double mu : {0.0, 0.5}) {
        Point point(floor(0.5, mu));
        const State flat = point.after({3, thickness, -2}, {0, 0, 0}, 2);
        CHECK(flat.position[0] == glm::dvec3(3, thickness, -2));
        CHECK(flat.velocity[0] == glm::dvec3(0));
        // a groove between two slopes
        point.problem.colliders = {slope(40 * degree, mu), slope(-40 * degree, mu)};
        const State groove = point.after({0.4, 1, 0}, {0, 0, 0}, 6);
        CHECK(groove.position[0].x == Approx(0).margin(1e-7));
        CHECK(groove.position[0].y == Approx(thickness / std::cos(40 * degree)).margin(1e-7));
        CHECK(glm::length(groove.velocity[0]) < 1e-7);
        // what happens does not depend on the step
        const State start{0, {{0.4, 1, 0}}, {{0, 0, 0}}};
        const int64_t events = integrateWithContact(point.problem, start, 6, 8).events;
        CHECK(events > 10);
        for (int steps : {50, 300, 2000}) {
            const ContactRun run = integrateWithContact(point.problem, start, 6, steps);
            CHECK(run.settled);
            CHECK(run.events == events);
        }
    }
}

TEST_CASE("reference: pins pass through, and what starts inside is put outside", "[reference][contact]") {
    Molecule molecule = test::pair(1, 1, 100, 1);
    molecule.vertices[0].pinned = true;
    Problem problem{.molecule = &molecule, .gravity = down, .colliders = {floor(0.5, 0.5)}};
    State start = restState(problem, {.position = {0, -1, 0}});
    start.velocity[0] = {7, 8, 9};
    const Solution solution = solve(problem, start, 1, 1e-8);
    CHECK(solution.converged);
    CHECK(solution.state.position[0] == start.position[0]);
    CHECK(solution.state.velocity[0] == start.velocity[0]);
    CHECK(solution.state.position[1].y >= thickness);
}

TEST_CASE("reference: friction holds what a spring pulls on, up to mu m g", "[reference][contact]") {
    const double mu = 0.5, k = 100;
    for (double share : {0.6, 0.99, 1.01, 1.5}) {
        Molecule molecule = test::pair(1, 1, k, 1);
        molecule.springs[0].restLength = 1 - share * mu * g / k;
        const Problem problem{.molecule = &molecule, .gravity = down, .colliders = {floor(0.3, mu)}};
        const State start = restState(problem, {.position = {0, thickness, 0}});
        const Solution solution = solve(problem, start, 1, 1e-9);
        REQUIRE(solution.converged);
        INFO("share " << share);
        CHECK((solution.state.position == start.position) == (share < 1));
        CHECK(solution.state.position[0].y == thickness);
        CHECK(solution.state.velocity[0] == glm::dvec3(0));
    }
}

TEST_CASE("reference: a sprung molecule that drops never gains energy", "[reference][contact]") {
    const Molecule molecule = test::pair(1, 0.5, 2000, 0);
    for (double e : {0.0, 0.5, 1.0}) {
        const Problem problem{.molecule = &molecule, .gravity = down, .colliders = {floor(e, 0.3)}};
        State state = restState(problem, {{0, 1, 0}, test::turned()}, {1, 0, 0.5}, {0, 2, 5});
        const double before = energy(problem, state);
        double last = before;
        for (int i = 0; i < 100; ++i) {
            const ContactRun run = integrateWithContact(problem, state, 0.02, 100);
            REQUIRE(run.settled);
            state = run.state;
            const double now = energy(problem, state);
            REQUIRE(now <= last + 1e-5 * before);  // Runge-Kutta's own drift at wh = 0.016
            last = now;
            for (const glm::dvec3& x : state.position)
                REQUIRE(x.y > thickness - 1e-11);
        }
        INFO("e " << e);
        CHECK(last < 0.9 * before);
    }
}

TEST_CASE("reference: a step keeps its order through impact, rest and release", "[reference][contact]") {
    const Molecule molecule = test::pair(1, 0.5, 300, 0.2);
    const Problem problem{.molecule = &molecule, .gravity = down, .colliders = {floor(0.4, 0)}};
    const State start = restState(problem, {{0, 0.3, 0}, test::turned()}, {0.2, 0, 0}, {0, 1, 2});
    const ContactRun exact = integrateWithContact(problem, start, 0.6, 12800);
    CHECK(exact.events > 5);
    double last = 0;
    for (int steps : {100, 200, 400}) {
        const double error = relativeError(integrate(problem, start, 0.6, steps), exact.state, 1);
        INFO(steps << " steps: " << error);
        if (last > 0) CHECK(std::log2(last / error) == Approx(4).margin(0.5));
        last = error;
    }
}

TEST_CASE("reference: a leaf comes to rest on a slope and stays", "[reference][contact]") {
    const Molecule molecule = test::leaf(2000, 20);
    Problem problem{.molecule = &molecule, .gravity = down, .colliders = {slope(20 * degree, 0.6)}};
    const State start = restState(problem, {{0, 1.6, 0}, test::turned()});
    const ContactRun landed = integrateWithContact(problem, start, 6, 6000);
    REQUIRE(landed.settled);
    for (const glm::dvec3& v : landed.state.velocity)
        CHECK(glm::length(v) < 1e-6);
    const ContactRun later = integrateWithContact(problem, landed.state, 1, 1000);
    CHECK(relativeError(later.state, landed.state, 1) < 1e-6);
}

TEST_CASE("reference: bounces without number are called so, and end", "[reference][contact]") {
    const Point point(floor(1, 0));
    const State low{0, {{0, thickness + 1e-10, 0}}, {{0, 0, 0}}};
    const Solution solution = solve(point.problem, low, 2, 1e-15, 2);
    CHECK_FALSE(solution.converged);
    CHECK(std::isfinite(solution.state.position[0].y));
}

}  // namespace shoal::reference
