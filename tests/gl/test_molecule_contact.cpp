// Contact of molecules with one another, against closed forms and the reference, on every path.
#include <algorithm>
#include <random>

#include "gl/marbles.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;
using glm::vec2;

TEST_CASE("two marbles meet head-on as in the closed form", "[molecule contact]") {
    const double radius = 0.05, m = 1, n = 3, speed = 2;
    const Path path = pathHere();
    const ContactResponse response = GENERATE(ContactResponse::simultaneous, ContactResponse::nearest);
    for (const double e : {0.0, 0.3, 1.0}) {
        Scene scene = marbles({{-0.3, 0.2, 0}}, radius, m);
        Scene other = marbles({{0.31, 0.2, 0}}, radius, n);
        scene.groups.push_back(other.groups[0]);
        scene.groups[1].name = "heavy";
        scene.contact.response = response;
        Simulation simulation = startedWith(scene, {{speed, 0, 0}, {-1, 0, 0}}, vec2(e, 0), path);
        test::run(simulation, 40);
        const double meets = (0.61 - 2 * radius) / (speed + 1);
        const double impulse = (1 + e) * (speed + 1) * m * n / (m + n);
        const double v = speed - impulse / m, w = -1 + impulse / n, after = 0.4 - meets;
        const Snapshot a = simulation.snapshot(0), b = simulation.snapshot(1);
        CAPTURE(name(path), name(response), e, a.velocities[0].x, b.velocities[0].x);
        CHECK(std::abs(a.velocities[0].x - v) < 1e-6);
        CHECK(std::abs(b.velocities[0].x - w) < 1e-6);
        CHECK(std::abs(a.positions[0].x - (-0.3 + speed * meets + v * after)) < 1e-5);
        CHECK(std::abs(b.positions[0].x - (0.31 - meets + w * after)) < 1e-5);
        CHECK(std::abs(a.positions[0].y - 0.2) < 1e-6);
    }
}

// Coulomb: what would stick loses all of its slip, what slides mu times the push; and the way since they
// touched is that of the velocities after.
TEST_CASE("two marbles that graze stick or slide as Coulomb has it", "[molecule contact]") {
    const double m = 1, n = 2.5, e = 0.2, reach = 0.13, speed = 2.6;
    const Path path = pathHere();
    // the slip over the push at offset b is (b / sqrt(reach^2 - b^2)) / (1 + e): what holds it, nearly holds
    // it, does not
    const double offset = 0.06, limit = offset / std::sqrt(reach * reach - offset * offset) / (1 + e);
    for (const double mu : {0.0, 0.5 * limit, 0.97 * limit, 1.03 * limit, 1.0}) {
        Scene scene = marbles({{-0.5, 0, 0}}, 0.05, m);
        scene.groups.push_back(marbles({{0.4, offset, 0}}, 0.08, n).groups[0]);
        scene.groups[1].name = "heavy";
        Simulation simulation =
            startedWith(scene, {{speed, 0, 0}, {0, 0, 0}}, vec2(float(e), float(mu)), path);
        test::run(simulation, 50);
        const dvec3 normal = dvec3(-std::sqrt(reach * reach - offset * offset), -offset, 0) / reach;
        const double approach = -speed * normal.x, meets = (0.9 + reach * normal.x) / speed;
        const dvec3 along = dvec3(speed, 0, 0) + approach * normal;
        const double mass = m * n / (m + n), push = (1 + e) * approach * mass;
        const double grip = std::min(mu * push, glm::length(along) * mass);
        const dvec3 impulse = push * normal - grip * glm::normalize(along);
        const dvec3 v = dvec3(speed, 0, 0) + impulse / m, w = -impulse / n;
        const Snapshot a = simulation.snapshot(0), b = simulation.snapshot(1);
        CAPTURE(name(path), mu / limit);
        CHECK(glm::distance(a.velocities[0], v) < 2e-6);
        CHECK(glm::distance(b.velocities[0], w) < 2e-6);
        CHECK(glm::distance(a.positions[0], dvec3(-0.5 + speed * meets, 0, 0) + v * (0.5 - meets)) < 1e-5);
        CHECK(glm::distance(b.positions[0], dvec3(0.4, offset, 0) + w * (0.5 - meets)) < 1e-5);
    }
}

namespace {

// A cloud of marbles of two masses that fly at random, and what the equations make of its first step.
struct Cloud {
    Scene scene;
    std::vector<dvec3> velocities;
    std::vector<reference::Sphere> expected;
    Pairs contacts;
};

constexpr double cloudStep = 0.01;

// `fastest`: m/s, of one along an axis. Above 1.5 nothing passes through anything for all that.
Cloud cloud(int count, double side, vec2 material, double fastest = 1.5) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, side), speed(-fastest, fastest);
    Cloud out;
    for (int g = 0; g < 2; ++g) {
        std::vector<dvec3> positions;
        for (int i = 0; i < count; ++i)
            positions.emplace_back(place(random), place(random), place(random));
        Scene part = marbles(positions, g == 0 ? 0.03 : 0.02, g == 0 ? 1 : 0.25);
        if (g == 0)
            out.scene = part;
        else
            out.scene.groups.push_back(part.groups[0]);
        out.scene.groups.back().name = g == 0 ? "heavy" : "light";
    }
    for (int i = 0; i < 2 * count; ++i)
        out.velocities.emplace_back(speed(random), speed(random), speed(random));
    out.expected = spheresOf(compile(out.scene));
    for (size_t i = 0; i < out.expected.size(); ++i) {
        out.expected[i].velocity = out.velocities[i];
        out.expected[i].position += cloudStep * out.velocities[i];
    }
    const bool swept = fastest > 1.5;
    if (swept) out.scene.contact.fastest = 2 * std::sqrt(3.0) * fastest;
    out.contacts = reference::touching(out.expected, swept ? cloudStep : 0);
    const reference::SphereResponse settings = {cloudStep, 0, double(material.x), double(material.y),
                                                compile(out.scene).contact.settings.iterations};
    reference::ContactMemory memory;
    reference::respond(out.expected, out.contacts, settings, memory);
    return out;
}

struct Difference {
    double velocity = 0, position = 0;  // m/s, m
};

Difference farthest(const std::vector<reference::Sphere>& some,
                    const std::vector<reference::Sphere>& others) {
    Difference out;
    for (size_t i = 0; i < some.size(); ++i) {
        out.velocity = std::max(out.velocity, glm::distance(some[i].velocity, others[i].velocity));
        out.position = std::max(out.position, glm::distance(some[i].position, others[i].position));
    }
    return out;
}

double energy(const std::vector<reference::Sphere>& spheres) {
    double sum = 0;
    for (const reference::Sphere& sphere : spheres)
        sum += glm::dot(sphere.velocity, sphere.velocity) / sphere.weight / 2;
    return sum;
}

}  // namespace

TEST_CASE("contacts that meet at once are the reference's", "[molecule contact]") {
    const Path path = pathHere();
    for (const vec2 material : {vec2(0, 0), vec2(0.5f, 0.4f), vec2(1, 0)}) {
        const Cloud c = cloud(400, 0.55, material);
        REQUIRE(c.contacts.size() > 300);
        Simulation simulation = startedWith(c.scene, c.velocities, material, path);
        simulation.frame();
        CHECK(simulation.contact()->dropped() == 0);
        const std::vector<reference::Sphere> found = statesOf(simulation);
        const Difference difference = farthest(found, c.expected);
        CAPTURE(name(path), material.x, difference.velocity, difference.position);
        // of up to 3 m/s: a grazing contact's normal is a root of rounded numbers, and impacts hand it on
        CHECK(difference.velocity < 3e-4);
        CHECK(difference.position < 2e-6);
    }
}

TEST_CASE("what has passed through another within a step is found and answered", "[molecule contact]") {
    const Path path = pathHere();
    const vec2 material(0.5f, 0.4f);
    const Cloud c = cloud(150, 0.55, material, 6);
    Simulation simulation = startedWith(c.scene, c.velocities, material, path);
    simulation.frame();
    CHECK(simulation.contact()->dropped() == 0);
    const Pairs found = simulation.contact()->found();
    CAPTURE(name(path), c.contacts.size(), cloud(150, 0.55, material).contacts.size());
    CHECK(missing(found, c.contacts).empty());
    CHECK(missing(c.contacts, found).empty());
    const Difference difference = farthest(statesOf(simulation), c.expected);
    CAPTURE(difference.velocity, difference.position);
    CHECK(difference.velocity < 2e-3);
    CHECK(difference.position < 2e-5);
}

// In free fall, so that what rests has a speed to rest below.
TEST_CASE("contacts remember over steps as the reference does", "[molecule contact]") {
    const Path path = pathHere();
    const vec2 material(0.2f, 0.5f);
    const dvec3 gravity(0, -5, 0);
    Cloud c = cloud(300, 0.4, material);
    c.scene.gravity = gravity;
    for (dvec3& v : c.velocities)
        v *= 0.2;
    Simulation simulation = startedWith(c.scene, c.velocities, material, path);
    std::vector<reference::Sphere> spheres = spheresOf(compile(c.scene));
    for (size_t i = 0; i < spheres.size(); ++i)
        spheres[i].velocity = c.velocities[i];
    const int iterations = simulation.plan().contact.settings.iterations;
    const reference::SphereResponse settings = {cloudStep, 2 * glm::length(gravity) * cloudStep,
                                                double(material.x), double(material.y), iterations};
    reference::ContactMemory memory;
    memory.loads.resize(spheres.size(), dvec3(0));
    for (int step = 0; step < 6; ++step) {
        simulation.frame();
        for (size_t i = 0; i < spheres.size(); ++i) {
            const dvec3 gained = gravity * cloudStep + spheres[i].weight * memory.loads[i];
            spheres[i].position += cloudStep * (spheres[i].velocity + 0.5 * gained);
            spheres[i].velocity += gained;
        }
        reference::respond(spheres, reference::touching(spheres), settings, memory);
        const Difference difference = farthest(statesOf(simulation), spheres);
        double remembered = 0;
        for (const dvec3& load : memory.loads)
            remembered += glm::length(load);
        CAPTURE(name(path), step, difference.velocity, difference.position, remembered);
        CHECK(remembered > 0.3);
        CHECK(simulation.contact()->dropped() == 0);
        CHECK(difference.velocity < 1e-4);
        CHECK(difference.position < 5e-6);
    }
}

TEST_CASE("contact keeps momentum and never adds energy, and a repeat gives the same bits",
          "[molecule contact]") {
    const Path path = pathHere();
    CAPTURE(name(path));
    for (const vec2 material : {vec2(0, 0.5f), vec2(1, 0)}) {
        const Cloud c = cloud(2000, 0.95, material);
        uint64_t hash = 0;
        for (int repeat = 0; repeat < 2; ++repeat) {
            Simulation simulation = startedWith(c.scene, c.velocities, material, path);
            std::vector<reference::Sphere> before = statesOf(simulation);
            const dvec3 start = momentum(before);
            double scale = 0;
            for (const reference::Sphere& sphere : before)
                scale += glm::length(sphere.velocity) / sphere.weight;
            for (int i = 0; i < 20; ++i) {
                simulation.frame();
                const std::vector<reference::Sphere> after = statesOf(simulation);
                // what overlapped at the start is pushed apart, which is no impact
                CHECK(energy(after) < energy(before) * 1.00001);
                before = after;
            }
            CHECK(glm::length(momentum(before) - start) < 1e-6 * scale);
            CHECK((repeat == 0 || simulation.hash() == hash));
            hash = simulation.hash();
        }
    }
}

namespace {

// A marble of 1 kg that flies up at the middle of a triangle of a quad at rest.
Scene marbleAtQuad(bool triangles) {
    Scene scene = test::sceneOf(test::shippedMolecule("quad"), SolverKind::leapfrog, {test::at({0, 1, 0})});
    scene.groups[0].contact.emplace().radius = 0.03;
    scene.groups[0].contact->triangles = triangles;
    const Triangle& t = scene.groups[0].molecule.triangles[0];
    dvec3 middle(0);
    for (const int corner : {t.a, t.b, t.c})
        middle += scene.groups[0].molecule.vertices[size_t(corner)].position / 3.0;
    Scene marble = marbles({middle + dvec3(0, 0.8, 0)}, 0.02, 0.002);
    scene.groups.push_back(marble.groups[0]);
    scene.groups[1].name = "marble";
    scene.groups[1].velocity = {0, 1.5, 0};
    test::setSteps(scene, 1 / 60.0, 8);
    return scene;
}

double momentumAlongY(const Simulation& simulation) {
    double sum = 0;
    for (size_t g = 0; g < 2; ++g) {
        const Snapshot snapshot = simulation.snapshot(g);
        for (size_t v = 0; v < snapshot.velocities.size(); ++v)
            sum += snapshot.velocities[v].y / double(simulation.plan().contact.groups[g].shapes[v].x);
    }
    return sum;
}

}  // namespace

TEST_CASE("a sphere on a triangle stops what its corners let through", "[molecule contact]") {
    const Path path = pathHere();
    if (path == Path::pingPong) return;
    for (const bool triangles : {false, true}) {
        Simulation simulation = simulationOn(path, compile(marbleAtQuad(triangles)));
        const double before = momentumAlongY(simulation);
        test::run(simulation, 20);
        const Snapshot marble = simulation.snapshot(1);
        CAPTURE(triangles, name(path));
        CHECK((marble.velocities[0].y < 0.8) == triangles);
        CHECK(std::abs(momentumAlongY(simulation) - before) < 1e-5 * before);
    }
}

TEST_CASE("spheres of one molecule meet only where it says so", "[molecule contact]") {
    const Path path = pathHere();
    if (path == Path::pingPong) return;
    CAPTURE(name(path));
    Molecule molecule = test::pair(1, 1, 0, 0);
    molecule.springs.clear();
    for (const bool self : {false, true}) {
        Scene scene =
            test::sceneOf(molecule, SolverKind::leapfrog, {test::at({0, 0, 0}), test::at({0, 3, 0})});
        scene.groups[0].contact.emplace().radius = 0.1;
        scene.groups[0].contact->self = self;
        test::setSteps(scene, 0.01, 1);
        Simulation simulation =
            startedWith(scene, {{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {-1, 0, 0}}, vec2(1, 0), path);
        test::run(simulation, 60);
        for (const size_t first : {size_t(0), size_t(2)})
            CHECK(std::abs(simulation.snapshot(0).velocities[first].x - (self ? -1 : 1)) < 1e-5);
    }
    // in their rest shape these touch already, and so they never meet
    Scene close = test::sceneOf(molecule, SolverKind::leapfrog);
    close.groups[0].contact.emplace().radius = 0.6;
    close.groups[0].contact->self = true;
    test::setSteps(close, 0.01, 1);
    Simulation simulation = startedWith(close, {{1, 0, 0}, {-1, 0, 0}}, vec2(1, 0), path);
    test::run(simulation, 60);
    CHECK(simulation.snapshot(0).velocities[0].x == 1);
}

TEST_CASE("UberFlow's response loses momentum where three meet, and only there", "[molecule contact]") {
    const auto lost = [](std::vector<dvec3> places, std::vector<dvec3> velocities, ContactResponse response) {
        Scene scene = marbles(places, 0.05);
        scene.contact.response = response;
        Simulation simulation = startedWith(scene, velocities, vec2(1, 0));
        test::run(simulation, 30);
        dvec3 sum(0);
        for (const dvec3& v : simulation.snapshot(0).velocities)
            sum += v;
        for (const dvec3& v : velocities)
            sum -= v;
        return glm::length(sum);
    };
    const std::vector<dvec3> places = {{0, 0, 0}, {0.2, 0, 0}, {-0.201, 0.01, 0}};
    const std::vector<dvec3> velocities = {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
    CHECK(lost(places, velocities, ContactResponse::nearest) > 0.1);
    CHECK(lost(places, velocities, ContactResponse::simultaneous) < 1e-5);
    CHECK(lost({places[0], places[1]}, {velocities[0], velocities[1]}, ContactResponse::nearest) < 1e-5);
}

TEST_CASE("a run with contact goes on from a saved state bit for bit", "[molecule contact]") {
    const Path path = pathHere();
    for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::bdf2Xpbd}) {
        if (path == Path::pingPong && shoal::solver(solver).implicit) continue;
        Scene scene = strewn(200, dvec3(0.9), 0.03);
        scene.solver.kind = solver;
        scene.gravity = {0, -9.81, 0};
        scene.colliders.emplace_back();
        scene.colliders.back().shape = PlaneCollider{};
        scene.contact.steps = 3;
        test::setSteps(scene, 1 / 60.0, 8);
        Simulation whole = simulationOn(path, compile(scene), true),
                   first = simulationOn(path, compile(scene)), second = simulationOn(path, compile(scene));
        test::run(whole, 12);
        test::run(first, 7);
        second.load(first.save());
        test::run(second, 5);
        CHECK(second.hash() == whole.hash());
        CHECK(whole.contact()->found().size() > 50);
    }
}

TEST_CASE("all paths agree on quads that touch in every contact step", "[molecule contact]") {
    if (!testContext().info().computeShaders) return;
    Scene scene = strewn(300, dvec3(0.8), 0.03);
    scene.groups[0].molecule.vertices[0].pinned = true;
    scene.gravity = {0, -9.8, 0};
    scene.contact.steps = 2;
    test::setSteps(scene, 0.004, 5);
    for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::euler}) {
        scene.solver.kind = solver;
        std::vector<Snapshot> states;
        for (const Path path : {Path::fused, Path::fragments, Path::pingPong}) {
            Simulation simulation = simulationOn(path, compile(scene));
            simulation.frame();
            CHECK(simulation.contact()->found().size() > 100);
            states.push_back(simulation.snapshot(0));
        }
        for (const Snapshot& other : {states[1], states[2]}) {
            double position = 0, velocity = 0;
            for (size_t i = 0; i < other.positions.size(); ++i) {
                position = std::max(position, glm::distance(states[0].positions[i], other.positions[i]));
                velocity = std::max(velocity, glm::distance(states[0].velocities[i], other.velocities[i]));
            }
            CAPTURE(name(solver), position, velocity);
            CHECK(position < 1e-5);
            CHECK(velocity < 5e-3);
        }
    }
}

TEST_CASE("the ping-pong path refuses what only the fused one has of contact", "[molecule contact]") {
    Scene scene = strewn(4, dvec3(1), 0.03);
    SECTION("triangles") {
        scene.groups[0].contact->triangles = true;
        CHECK_THROWS_WITH(
            simulationOn(Path::pingPong, compile(scene)),
            Catch::Contains("contact of spheres on triangles") && Catch::Contains("needs the fused path"));
    }
    SECTION("self") {
        scene.groups[0].contact->self = true;
        CHECK_THROWS_WITH(
            simulationOn(Path::pingPong, compile(scene)),
            Catch::Contains("contact within a molecule") && Catch::Contains("needs the fused path"));
    }
}

// Masses up to which no warning comes, and eight times as much. The iterations of ping-pong know no
// colliders.
TEST_CASE("a marble carries so many times its mass as its iterations tell", "[molecule contact]") {
    const Path path = pathHere();
    if (path == Path::pingPong) return;
    const int iterations = GENERATE(4, 16, 64, 256);
    if (iterations > 16 && path != Path::fused) return;  // half a minute
    const double radius = 0.05, carried = ContactPlan::carried(iterations);
    Scene scene;
    for (const double ratio : {carried, 8 * carried, 2 * carried}) {
        Scene light = marbles({{double(scene.groups.size()), radius, 0}}, radius),
              heavy = marbles({{double(scene.groups.size()), 3 * radius, 0}}, radius, ratio);
        light.groups[0].name = concat("under ", ratio);
        heavy.groups[0].name = concat(ratio);
        for (Scene* part : {&light, &heavy})
            scene.groups.push_back(part->groups[0]);
    }
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = 4;
    scene.contact.iterations = iterations;
    scene.colliders.push_back({.name = "floor", .shape = PlaneCollider(), .restitution = 0, .friction = 0.5});
    Simulation simulation = startedWith(scene, std::vector<dvec3>(6, dvec3(0)), glm::vec2(0, 0.5), path);
    double fastest[3] = {}, deepest[3] = {}, sunk = 0;
    for (int i = 0; i < 300; ++i) {
        simulation.frame();
        for (size_t stack = 0; stack < 3; ++stack) {
            const Snapshot below = simulation.snapshot(2 * stack), above = simulation.snapshot(2 * stack + 1);
            const double depth = 2 * radius - glm::distance(below.positions[0], above.positions[0]);
            if (stack == 2) sunk = std::max(sunk, depth);
            if (i < 240) continue;
            fastest[stack] = std::max({fastest[stack], glm::length(dvec3(below.velocities[0])),
                                       glm::length(dvec3(above.velocities[0]))});
            deepest[stack] = std::max(deepest[stack], depth);
        }
    }
    CAPTURE(name(path), iterations, carried, fastest[1], deepest[1] / (2 * radius), sunk / (2 * radius));
    CHECK(fastest[0] < 1e-3);
    CHECK(deepest[0] < 0.01 * 2 * radius);
    CHECK(fastest[1] > 0.01);
    CHECK(sunk < 0.21 * 2 * radius);  // contact/response/pair.glsl: how fast memory grows
}

}  // namespace shoal
