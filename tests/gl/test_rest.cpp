// Molecules at rest (shaders/contact/rest/rest.pass.glsl): they cost nothing, change nothing, and wake when
// something happens to them.
#include <algorithm>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace shoal::test;
using glm::dvec3;

namespace {

Simulation fusedOf(const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.drawn = false, .path = Path::fused});
}

PlaneCollider floorAt(double height) {
    PlaneCollider out;
    out.point = {0, height, 0};
    return out;
}

// Marbles of 10 cm on a floor, which may rest.
Scene marbles(const std::vector<dvec3>& positions, double friction = 0.5) {
    std::vector<Item> items;
    for (const dvec3& p : positions)
        items.push_back(at(p));
    Scene scene = sceneOf(point(1), SolverKind::leapfrog, items);
    scene.groups[0].contact.emplace().radius = 0.05;
    scene.gravity = {0, -9.81, 0};
    scene.colliders.emplace_back().shape = floorAt(0);
    scene.colliders[0].friction = friction;
    scene.colliders[0].thickness = 0.05;
    scene.contact.rest = 0.005;
    setSteps(scene, 1 / 60.0, 2);
    return scene;
}

// Two layers, the upper of which lies in the hollows of the lower.
std::vector<dvec3> twoLayers() {
    std::vector<dvec3> out;
    for (int i = 0; i < 16; ++i)
        out.emplace_back(0.1 * (i % 4), 0.05, 0.1 * (i / 4));
    for (int i = 0; i < 9; ++i)
        out.emplace_back(0.05 + 0.1 * (i % 3), 0.122, 0.05 + 0.1 * (i / 3));
    return out;
}

size_t resting(const Simulation& simulation) {
    const std::vector<glm::vec4> loads = simulation.save().contacts.loads;
    return size_t(
        std::count_if(loads.begin(), loads.end(), [](const glm::vec4& load) { return load.w > 0; }));
}

double fastest(const Simulation& simulation) {
    double out = 0;
    for (const dvec3& v : simulation.snapshot(0).velocities)
        out = std::max(out, glm::length(v));
    return out;
}

}  // namespace

TEST_CASE("a heap comes to rest, and goes on resting from a saved state to the bit", "[rest]") {
    if (!canFuse()) return;
    const Scene scene = marbles(twoLayers());
    Simulation simulation = fusedOf(scene);
    run(simulation, 240);
    CHECK(resting(simulation) == 25);
    Scene awake = scene;
    awake.contact.rest = {};
    Simulation other = fusedOf(awake);
    run(other, 240);
    CHECK(resting(other) == 0);
    for (size_t i = 0; i < 25; ++i)
        CHECK(glm::distance(simulation.snapshot(0).positions[i], other.snapshot(0).positions[i]) < 0.002);

    Simulation whole = fusedOf(scene), first = fusedOf(scene), second = fusedOf(scene);
    run(whole, 120);
    run(first, 70);
    second.load(first.save());
    run(second, 50);
    CHECK(second.hash() == whole.hash());
}

TEST_CASE("an impact on what rests is that on what does not", "[rest]") {
    if (!canFuse()) return;
    // a row that touches, and a marble that comes along it
    std::vector<dvec3> row;
    for (int i = 0; i < 4; ++i)
        row.emplace_back(0.1 * i, 0.05, 0);
    row.emplace_back(-1.5, 0.05, 0);
    std::vector<std::vector<dvec3>> velocities;
    for (const bool rests : {true, false}) {
        Scene scene = marbles(row, 0);
        scene.groups[0].contact->radius = 0.0501;
        if (!rests) scene.contact.rest = {};
        Plan plan = compile(scene);
        for (glm::vec2& pair : plan.contact.pairs)
            pair = {1, 0};
        plan.groups[0].start.velocities[4] = {1, 0, 0};
        Simulation simulation(testContext(), plan, {.drawn = false, .path = Path::fused});
        run(simulation, 60);
        CHECK(resting(simulation) == (rests ? 4 : 0));
        run(simulation, 30);
        velocities.push_back(simulation.snapshot(0).velocities);
    }
    for (size_t i = 0; i < 5; ++i) {
        CAPTURE(i, velocities[0][i].x, velocities[1][i].x);
        CHECK(glm::distance(velocities[0][i], velocities[1][i]) < 0.01);
    }
    CHECK(velocities[0][3].x > 0.2);
}

TEST_CASE("what rests wakes when what it lies on goes", "[rest]") {
    if (!canFuse()) return;
    Scene scene = marbles(twoLayers());
    ColliderPath path;  // the floor sinks after 4 s
    path.keyframes = {{0, {}}, {4, {}}, {8, {.position = {0, -4, 0}}}};
    scene.colliders[0].path = path;
    Simulation simulation = fusedOf(scene);
    run(simulation, 230);
    CHECK(resting(simulation) == 25);
    run(simulation, 40);
    CHECK(resting(simulation) == 0);
    const Snapshot now = simulation.snapshot(0);
    for (size_t i = 0; i < 16; ++i)
        CHECK(now.velocities[i].y == Approx(-1).margin(0.3));
}

TEST_CASE("what rests wakes when something heavy is laid on it", "[rest]") {
    if (!canFuse()) return;
    // four marbles without friction, held together by a rim; a heavy one comes down slowly on a path
    Scene scene = marbles({{0, 0.05, 0}, {0.1, 0.05, 0}}, 0);
    Group heavy = scene.groups[0];
    heavy.name = "heavy";
    heavy.molecule = point(20);
    heavy.place.items = {at({0.05, 0.4, 0})};
    heavy.count = 1;
    scene.groups.push_back(heavy);
    Simulation simulation = fusedOf(scene);
    run(simulation, 60);
    const Snapshot now = simulation.snapshot(0);
    CHECK(now.positions[0].x < -0.05);
    CHECK(now.positions[1].x > 0.15);
}

TEST_CASE("a heap in a box comes to rest as a whole", "[rest]") {
    if (!canFuse()) return;
    constexpr int side = 10;
    std::vector<dvec3> places;
    for (int layer = 0; layer < 6; ++layer)
        for (int i = 0; i < side * side; ++i)
            places.emplace_back(0.1 * (i % side) + 0.002 * (layer % 3), 0.051 + 0.102 * layer,
                                0.1 * (i / side) + 0.003 * (layer % 2));
    Scene scene = marbles(places);
    for (const dvec3& normal : {dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)}) {
        PlaneCollider wall;
        wall.normal = normal;
        wall.point = dvec3(0.05 * (side - 1)) - normal * (0.05 * side + 0.005);
        Collider& collider = scene.colliders.emplace_back();
        collider.shape = wall;
        collider.thickness = 0.05;
    }
    Simulation simulation = fusedOf(scene);
    run(simulation, 360);  // 598 rest after 160; of the last few when is a matter of luck
    CHECK(resting(simulation) == places.size());
    // nothing hangs: each lies on the floor or touches one below
    const std::vector<dvec3> now = simulation.snapshot(0).positions;
    for (const dvec3& p : now)
        CHECK((p.y < 0.0505 || std::any_of(now.begin(), now.end(), [&](const dvec3& below) {
                   return below.y < p.y && glm::distance(below, p) < 0.1 * 1.02;
               })));
}

TEST_CASE("what rests wakes when what bears it is blown away", "[rest]") {
    if (!canFuse()) return;
    // one on three, which a wind that it does not feel itself moves in the end
    Scene scene = marbles({{-0.05, 0.05, 0}, {0.05, 0.05, 0}, {0, 0.05, 0.0866}}, 0.2);
    Group upper = scene.groups[0];
    upper.name = "upper";
    upper.place.items = {at({0, 0.132, 0.0289})};
    upper.count = 1;
    scene.groups[0].drag = {2, 2};
    scene.groups.push_back(upper);
    scene.fields.emplace_back().shape = OscillatingField{.velocity = {0, 0, 3}, .frequency = 0.05};
    Simulation simulation = fusedOf(scene);
    run(simulation, 40);
    CHECK(resting(simulation) == 4);
    run(simulation, 260);
    CHECK(simulation.snapshot(1).positions[0].y < 0.06);
}

TEST_CASE("what rests wakes when a slider or a field changes what acts on it", "[rest]") {
    if (!canFuse()) return;
    Scene scene = marbles(twoLayers());
    scene.groups[0].drag = {2, 2};
    SECTION("gravity") {
        Simulation simulation = fusedOf(scene);
        run(simulation, 240);
        CHECK(resting(simulation) == 25);
        simulation.parameters.gravity = {9.81, -3, 0};
        run(simulation, 20);
        CHECK(fastest(simulation) > 1);
    }
    SECTION("wind to and fro, once too little to wake anything") {
        OscillatingField wind;
        wind.frequency = 0.5;
        for (const bool strong : {false, true}) {
            wind.velocity = {0, 0, strong ? 5 : 0.1};
            scene.fields.clear();
            scene.fields.emplace_back().shape = wind;
            Simulation simulation = fusedOf(scene);
            run(simulation, 240);
            CHECK(resting(simulation) == (strong ? 0 : 25));
        }
    }
}

// The larger of `rest` and of a tenth of what gravity adds in a contact step (docs/contact.md).
TEST_CASE("what rests wakes by what changes its velocity by more than a threshold of two terms", "[rest]") {
    if (!canFuse()) return;
    const double step = 1 / 120.0;
    const double rest = GENERATE(0.001, 0.02);
    const double threshold = std::max(rest, 0.1 * 9.81 * step);  // m/s
    const auto leastResting = [&](double part) {
        const double friction = 0.05;
        Scene scene = marbles({{0, 0.05, 0}}, friction);
        scene.contact.rest = rest;
        scene.groups[0].drag = {2, 2};
        // friction holds the marble until it rests, at a phase of 0.1 rad; in the end that is pi / 2
        OscillatingField wind;
        wind.velocity = {0, 0, (part * threshold / step + friction * 9.81) / 2};
        wind.frequency = 0.05;
        scene.fields.emplace_back().shape = wind;
        Simulation simulation = fusedOf(scene);
        run(simulation, 40);
        REQUIRE(resting(simulation) == 1);
        size_t least = 1;
        for (int i = 0; i < 270; ++i) {
            run(simulation, 1);
            least = std::min(least, resting(simulation));
        }
        return least;
    };
    CAPTURE(rest);
    CHECK(leastResting(0.95) == 1);
    CHECK(leastResting(1.25) == 0);
}

TEST_CASE("where nothing rests a warning says so", "[rest]") {
    const Scene scene = marbles({{0, 0.05, 0}});
    const Simulation simulation(testContext(), compile(scene), {.drawn = false, .path = Path::pingPong});
    REQUIRE(simulation.warnings().size() == 1);
    CHECK_THAT(simulation.warnings()[0].message, Catch::Contains("\"rest\" changes nothing here"));
    if (!canFuse()) return;
    CHECK(fusedOf(scene).warnings().empty());
}

TEST_CASE("rest that cannot be is refused", "[rest]") {
    Scene scene = marbles({{0, 0.05, 0}});
    scene.contact.rest = 0.1;
    CHECK_THAT(messageOf([&] { (void)compile(scene); }),
               Catch::Contains("\"rest\" of 0.1 m/s is more than what falls gains in a contact step"));
    scene.contact.rest = 0.01;
    scene.contact.search = ContactSearch::single;
    CHECK_THAT(messageOf([&] { (void)compile(scene); }), Catch::Contains("\"rest\" needs the exact search"));
}
