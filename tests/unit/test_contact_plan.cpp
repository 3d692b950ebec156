// How a scene's contact between molecules becomes a plan, and the pure functions of its shaders.
#include <cmath>
#include <random>

#include "compile/plan.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/shader_physics.h"
#include "support/shapes.h"
#include "support/small_scene.h"

#include "scene/json/scene_file.h"

namespace shoal {

using glm::dvec3;
using glm::vec3;

namespace {

Scene leavesOf(double radius) {
    Scene scene;
    Group group;
    group.name = "leaves";
    group.molecule = test::leaf(10, 0.1);
    group.count = 3;
    group.place.kind = Placement::Kind::volume;
    group.place.scale = {1, 2};
    group.contact.emplace().radius = radius;
    scene.groups.push_back(group);
    return scene;
}

}  // namespace

TEST_CASE("contact's cells hold two of the largest spheres side by side", "[contact plan]") {
    for (const double radius : {1e-6, 0.013, 0.05, 7.7}) {
        const ContactPlan plan = compile(leavesOf(radius)).contact;
        CHECK(plan.spheres == 12);
        CHECK(plan.largestRadius > radius);
        CHECK(plan.largestRadius <= 2 * radius * (1 + 1e-6));
        CHECK(plan.cell >= 4 * plan.largestRadius);
        CHECK(plan.cell <= 4 * plan.largestRadius * 1.07);
        int exponent = 0;
        const double mantissa = std::frexp(plan.cell, &exponent) * 32;
        CHECK(mantissa == std::floor(mantissa));
    }
}

TEST_CASE("spheres on triangles follow those of the vertices", "[contact plan]") {
    Scene scene = leavesOf(0.1);
    scene.groups[0].contact->triangles = true;
    scene.groups[0].contact->self = true;
    const ContactGroup group = compile(scene).contact.groups.at(0);
    CHECK(group.spheresOf == 6);
    REQUIRE(group.points.size() == 2);
    CHECK(group.points[1].corners == glm::ivec3(0, 2, 3));
    // vertex 0 is a corner of both
    CHECK(group.shapes[0].w == 2);
    CHECK(group.shapes[size_t(group.shapes[0].z)].x == 4);
    CHECK(group.shapes[size_t(group.shapes[0].z) + 1].x == 5);
    // everything is further apart than two radii, but from itself
    for (size_t k = 0; k < 6; ++k)
        CHECK(group.apart[k] == 1u << k);
}

TEST_CASE("the largest gap of a triangle is that of its circumcircle", "[contact plan]") {
    Molecule molecule;
    molecule.name = "triangle";
    for (const dvec3& p : {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0.5, 0, std::sqrt(0.75))})
        molecule.vertices.push_back({.position = p});
    molecule.triangles = {{0, 2, 1}};
    GroupContact contact;
    contact.radius = 0.2;
    CHECK(std::abs(largestGap(molecule, contact).radius - (1 / std::sqrt(3.0) - 0.2)) < 0.02);
    contact.triangles = true;  // then it is the middle between two corners and the middle
    CHECK(std::abs(largestGap(molecule, contact).radius - (1 / 3.0 - 0.2)) < 0.02);
    contact.radius = 0.6;
    CHECK(largestGap(molecule, contact).triangle == -1);
}

// A sphere that lies anywhere on an edge or a triangle overlaps one of those that close it, and two edges
// that cross bring two of their spheres within 1.5 radii.
TEST_CASE("spheres that close a molecule leave no gap in triangles of any shape", "[contact plan]") {
    Molecule molecule;
    molecule.name = "two triangles";
    for (const dvec3& p : {dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0.9, 0, 0.5), dvec3(0.1, 0.2, -0.1)})
        molecule.vertices.push_back({.position = p});
    molecule.triangles = {{0, 2, 1}, {0, 1, 3}};
    for (const double radius : {0.6, 0.3, 0.1, 0.04}) {
        const std::vector<TrianglePoint> points = closingPoints(molecule, radius);
        const std::vector<dvec3> spheres = restSpheres(molecule, points);
        CAPTURE(radius, points.size());
        CHECK(largestGap(molecule, spheres, radius).radius < radius);
        // the edge that both have is closed once
        int shared = 0;
        for (const TrianglePoint& point : points)
            shared += point.corners == glm::ivec3(0, 1, 1);
        CHECK(shared == int(std::ceil(1 / (2 * radius))) - 1);
        for (int i = 0; i <= 100; ++i) {
            double nearest = 1e300;
            for (const dvec3& sphere : spheres)
                nearest = std::min(nearest, glm::distance(sphere, dvec3(i / 100.0, 0, 0)));
            CHECK(nearest <= radius * (1 + 1e-9));
        }
    }
    CHECK(closingPoints(molecule, 0.6).empty());
    CHECK(leastClosingRadius(molecule) > 1 / 32.0);
}

TEST_CASE("contact that is probably not meant is warned of", "[contact plan]") {
    const auto warns = [](const Scene& scene, const char* text) {
        for (const Warning& warning : compile(scene).warnings)
            if (warning.message.find(text) != std::string::npos) return true;
        return false;
    };
    Scene scene = leavesOf(0.05);
    scene.contact.location = {"s.json", 1, 1, "$.contact"};
    scene.solver.substeps = 4;
    scene.contact.steps = 4;
    CHECK_FALSE(warns(scene, "contact"));
    CHECK_FALSE(warns(scene, "larger than the molecule"));
    scene.contact.steps = 8;
    CHECK(warns(scene, "8 steps runs 4 times a frame"));
    CHECK(warns(leavesOf(25), "larger than the molecule"));
    scene.groups[0].contact.reset();
    CHECK(warns(scene, "no group has \"contact\""));
}

TEST_CASE("unlike masses take more iterations where the scene does not say how many", "[contact plan]") {
    Scene scene = leavesOf(0.05);
    for (const auto& [ratio, iterations] :
         {std::pair(1.0, 8), std::pair(4.0, 16), std::pair(100.0, 80), std::pair(1e5, 256)}) {
        for (Vertex& vertex : scene.groups[0].molecule.vertices)
            vertex.mass = 0.5;
        scene.groups[0].molecule.vertices.back().mass = 0.5 * ratio;
        scene.contact.iterations = 0;
        CHECK(compile(scene).contact.settings.iterations == iterations);
        scene.contact.iterations = 5;
        CHECK(compile(scene).contact.settings.iterations == 5);
    }
}

TEST_CASE("what is too heavy for what it may come to lie on is told", "[contact plan]") {
    const auto heavier = [](double ratio, int iterations) {
        Scene scene = leavesOf(0.05);
        scene.gravity = {0, -9.81, 0};
        scene.contact.iterations = iterations;
        for (Vertex& vertex : scene.groups[0].molecule.vertices)
            vertex.mass = 0.5;
        Group heavy = scene.groups[0];
        heavy.name = "iron";
        heavy.molecule.vertices.back().mass = 0.5 * ratio;
        scene.groups.push_back(heavy);
        return scene;
    };
    const auto warning = [](const Scene& scene) {
        for (const Warning& each : compile(scene).warnings)
            if (each.message.find("times as heavy") != std::string::npos) return each.message;
        return std::string();
    };
    CHECK(warning(heavier(24, 4)).empty());
    CHECK(warning(heavier(95, 8)).empty());
    CHECK(warning(heavier(95, 7)) ==
          "what contact moves of \"iron\" is 95 times as heavy as of \"leaves\": where it lies on that, it "
          "sinks "
          "in or sways with less than 8 \"iterations\", and in a tower with less than 78, which a scene has "
          "that does not say how many");
    CHECK_THAT(warning(heavier(5000, 64)), Catch::Contains("with less than 142 \"iterations\""));
    CHECK_THAT(warning(heavier(5e4, 64)),
               Catch::Contains("256 \"iterations\", which are the most, carry 16384 times"));
    CHECK(warning(heavier(16000, 0)).empty());
    CHECK_THAT(warning(heavier(17000, 0)), Catch::Contains("256 \"iterations\", which are the most"));
    Scene scene = heavier(1000, 4);
    scene.gravity = dvec3(0);
    CHECK(warning(scene).empty());
    scene = heavier(1000, 4);
    for (Vertex& vertex : scene.groups[1].molecule.vertices)
        vertex.pinned = true;
    CHECK(warning(scene).empty());
    scene = heavier(1e6, 4);
    CHECK(messageOf([&] { compile(scene); }).empty());
    scene = heavier(1.1e6, 4);
    CHECK_THAT(messageOf([&] { compile(scene); }),
               Catch::Contains("what contact moves of \"iron\" is 1.1e+06 times as heavy as of \"leaves\""));
}

TEST_CASE("contact's mistakes are told", "[contact plan]") {
    Scene scene = leavesOf(0.1);
    scene.contact.cell = 0.3;
    scene.contact.location = {"s.json", 1, 1, "$.contact"};
    CHECK(messageOf([&] { compile(scene); }).find("$.contact.cell") != std::string::npos);
    CHECK(messageOf([&] { compile(scene); }).find("do not hold spheres of radius") != std::string::npos);
    const test::Scratch scratch;
    const auto complaint = [&](const std::string& contact, const std::string& settings = "") {
        std::string text = test::smallScene;
        const std::string after = "\"collide\": false";
        text.insert(text.find(after) + after.size(), ", \"contact\": " + contact);
        if (!settings.empty()) text.insert(1, "\"contact\": " + settings + ",");
        return messageOf([&] { readScene(test::writeSmallScene(scratch, text)); });
    };
    CHECK(complaint("{}").empty());  // it has a radius that closes the gaps
    CHECK(complaint("{\"radius\": 0}").find("at least 1e-09") != std::string::npos);
    CHECK(complaint("{\"radius\": 0.1, \"neighbors\": 3}").find("neighbors") != std::string::npos);
    CHECK(complaint("{\"radius\": 0.1}", "{\"neighbors\": 3}").find("\"search\": \"single\" or") !=
          std::string::npos);
    CHECK(complaint("{\"radius\": 0.1}", "{\"search\": \"exakt\"}").find("exact") != std::string::npos);
    CHECK(complaint("{\"radius\": 0.1}", "{\"search\": \"single\", \"neighbors\": 3}").empty());
}

TEST_CASE("places in the grid tell differences exactly, wherever they are", "[contact plan]") {
    // m: of 13 / 128, of millimetres, coarser than the anchors' lattice, and a power of two
    const float cell = GENERATE(0.1015625f, 0.00177001953125f, 3.125f, 0.5f);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anchorAt(-1e6, 1e6), at(-1, 1), off(-0.9 * cell, 0.9 * cell);
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto anchor = [&] {
            return vec3(glm::floor(dvec3(anchorAt(random), anchorAt(random), anchorAt(random)) * 16.0) /
                        16.0);
        };
        const vec3 a = anchor(), shift = vec3(float(i % 3) - 1, 0.0625f * float(i % 5), 0);
        const vec3 x(at(random), at(random), at(random));
        const vec3 y = x - shift + vec3(off(random), off(random), off(random));
        const shader::CellPlace p = shader::cellPlace(a, x, cell), q = shader::cellPlace(a + shift, y, cell);
        const dvec3 exact = (dvec3(a) - dvec3(a + shift)) + (dvec3(x) - dvec3(y));
        worst = std::max(worst, glm::length(dvec3(shader::localDifference(p.local, q.local, cell)) - exact));
        const dvec3 cells = glm::floor((dvec3(a) + dvec3(x)) / double(cell) + 1e-4);
        CHECK(glm::length(dvec3(p.cell) - cells) < 2);
        CHECK(glm::all(glm::lessThanEqual(glm::abs(p.cell - q.cell), glm::ivec3(1))));
    }
    CHECK(worst < 3e-7 * std::max(1.0, 4.0 * cell));  // a local place is within four cells
}

TEST_CASE("the next impact of two spheres counts from when they began to move straight", "[contact plan]") {
    // a moves at 2 m/s along x past b, 0.06 m aside; they touch where the distance is 0.1 m
    const vec3 u(2, 0, 0), d(-0.08f + 2 * 0.004f, 0.06f, 0);
    const shader::PairImpact c = shader::nextImpact(d, u, 0.1f, 0.005f, 0.01f);
    CHECK(c.happens);
    CHECK(std::abs(c.since - 0.004f) < 1e-6f);
    CHECK(glm::distance(c.normal, vec3(-0.8f, 0.6f, 0)) < 1e-5f);
    CHECK(std::abs(c.speed + 1.6f) < 1e-5f);
    const shader::PairImpact mirrored = shader::nextImpact(-d, -u, 0.1f, 0.005f, 0.01f);
    CHECK((mirrored.since == c.since && mirrored.speed == c.speed && mirrored.normal == -c.normal));
    // they overlapped when it began, and approached: it is then
    const shader::PairImpact late = shader::nextImpact(d, u, 0.1f, 0.003f, 0.01f);
    CHECK((late.happens && late.since == 0.003f));
    CHECK_FALSE(shader::nextImpact(d, -u, 0.1f, 0.003f, 0.01f).happens);            // they part
    CHECK_FALSE(shader::nextImpact(d, u, 0.1f, 0.005f, 1.7f).happens);              // too slow
    CHECK_FALSE(shader::nextImpact(d - u * 0.005f, u, 0.1f, 0.005f, 0).happens);    // not yet
    CHECK_FALSE(shader::nextImpact(vec3(0.3f, 0.101f, 0), u, 0.1f, 1, 0).happens);  // passed beside
    // it has left on the other side since, 0.1 m further
    const shader::PairImpact through = shader::nextImpact(d + u * 0.1f, u, 0.1f, 0.1041f, 0.01f);
    CHECK(through.happens);
    CHECK(std::abs(through.since - 0.104f) < 1e-6f);
    CHECK(glm::distance(through.normal, vec3(-0.8f, 0.6f, 0)) < 1e-5f);
    CHECK_FALSE(shader::nextImpact(vec3(0), vec3(0, 1, 0), 0.1f, 0, 0).happens);  // they coincide, and part
}

TEST_CASE("two spheres have a depth along the line of their centres, below zero while they are apart",
          "[contact plan]") {
    const shader::PairContact c = shader::pairContact(vec3(0.101f, 0, 0), vec3(-5, 0, 0), 0.1f);
    CHECK(c.normal == vec3(1, 0, 0));
    CHECK(std::abs(c.depth + 0.001f) < 1e-7f);
    CHECK(c.speed == -5);
}

TEST_CASE("spheres whose centres coincide leave one another in directions that agree", "[contact plan]") {
    const uint32_t first = GENERATE(0u, 1000u, (1u << 27) - 125);
    vec3 mean(0);
    for (uint32_t a = 0; a < 125; ++a) {
        for (uint32_t b = 0; b < a; ++b) {
            const vec3 n = shader::directionFrom(first + b, first + a);
            CHECK(std::abs(glm::length(n) - 1) < 1e-6f);
            CHECK(shader::directionFrom(first + a, first + b) == -n);
            mean += glm::abs(n) / (125 * 62.0f);
        }
    }
    for (int i = 0; i < 3; ++i)
        CHECK(std::abs(mean[i] - 0.5f) < 0.1f);  // no axis is preferred
}

TEST_CASE("an impulse of a contact alone gives it its velocity at once, and stops its slip",
          "[contact plan]") {
    const vec3 n(0, 0.6f, 0.8f), pushed = 0.3f * n, u(1, -2, 0.5f);
    const float weight = 3;
    const vec3 impulse = shader::pairImpulse(u, n, 0.7f, pushed, glm::vec2(weight));
    CHECK(glm::distance(u + (impulse - pushed) * weight, 0.7f * n) < 1e-6f);
    // a larger weight across the normal takes a smaller step of what slips, and the same along it
    const vec3 slower = shader::pairImpulse(u, n, 0.7f, pushed, glm::vec2(weight, 2 * weight));
    const vec3 left = u + (slower - pushed) * weight;
    CHECK(std::abs(glm::dot(left, n) - 0.7f) < 1e-6f);
    CHECK(glm::distance(left - 0.7f * n, 0.5f * (u - n * glm::dot(u, n))) < 1e-6f);
}

TEST_CASE("an impulse is brought into Coulomb's cone without a change along the normal", "[contact plan]") {
    const vec3 n(0, 1, 0);
    const vec3 within(0.3f, 1, -0.2f);
    CHECK(shader::withinFriction(within, n, 0.5f) == within);
    CHECK(glm::distance(shader::withinFriction({3, 1, -4}, n, 0.5f), vec3(0.3f, 1, -0.4f)) < 1e-6f);
    CHECK(shader::withinFriction({3, 1, -4}, n, 0) == n);
    CHECK(shader::withinFriction({3, -1, -4}, n, 0.5f) == vec3(0));
    CHECK(shader::withinFriction(vec3(0), n, 0.5f) == vec3(0));
}

TEST_CASE("contacts that act together count as the largest eigenvalue of their sum", "[contact plan]") {
    const auto countOf = [](const std::vector<vec3>& normals) {
        shader::ContactSum sum = shader::noContacts();
        for (const vec3& n : normals)
            sum = shader::withContact(sum, n, glm::vec2(1));
        return shader::effectiveCount(sum);
    };
    const vec3 slanted(0.6f, 0, 0.8f);
    const float across = shader::frictionStep;
    const float most = 2 + 2 * across;  // of the four, along x; 1 + 3 across along y and z
    // the norm of the eighth powers is a bound that no more than 3^(1/8) can exceed
    const float ofFour = countOf({vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)});
    CHECK(std::abs(countOf(std::vector<vec3>(5, slanted)) - 5) < 0.002f);
    CHECK(ofFour >= most);
    CHECK(ofFour < 1.15f * most);
    CHECK(countOf({}) == 1);
    // alone is a single one, wherever it points; two that are perpendicular are not
    CHECK(shader::isAlone(countOf({slanted})));
    CHECK_FALSE(shader::isAlone(countOf({vec3(1, 0, 0), vec3(0, 1, 0)})));
    CHECK_FALSE(shader::isAlone(countOf({slanted, slanted})));
}

TEST_CASE("contacts of a body count as the largest eigenvalue of how they move it", "[contact plan]") {
    // Impulses along z at (1, 0, 0) of a body of mass 1 and inertia 1 change the velocity there by (1 + 1)
    // each: the sum S holds half of every contact, X is the cross product with the arm.
    const auto countOf = [](float contacts) {
        const glm::mat3 sum(0, 0, 0, 0, 0, 0, 0, 0, 0.5f * contacts);
        const glm::mat3 arm(0, 0, 0, 0, 0, 1, 0, -1, 0);
        const glm::mat3 turned = sum * glm::transpose(arm);
        return shader::effectiveCount(sum, turned, glm::transpose(turned), arm * turned);
    };
    CHECK(std::abs(countOf(3) - 3) < 1e-5f);
    CHECK(std::abs(countOf(12) - 12) < 1e-4f);
    CHECK(countOf(0.5f) ==
          1.01f);  // never alone: its turning couples what is along a normal and what is across
}

}  // namespace shoal
