// "school": read, and refused with the place of what is wrong; its grids; its rules, which the GPU runs.
#include <cmath>
#include <set>

#include "compile/muscle_limits.h"
#include "compile/path.h"
#include "compile/plan.h"
#include "molecule/molecule_file.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/shader_physics.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

Scene shoalOf(const std::string& school, const std::string& otherGroups = "") {
    return parseScene(
        R"({"format": "shoal-scene-1", "solver": {"method": "leapfrog", "substeps": 5}, "groups": [
{"name": "fry", "molecule": "fry.json", "count": 5, "drag": {"normal": 40, "tangent": 1},
 "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}, "school": {)" +
            school + "}}" + otherGroups + "]}",
        SHOAL_SOURCE_DIR "/molecules/s.json");
}

const std::string hunter = R"(, {"name": "hunter", "molecule": "hunter.json", "count": 2,
 "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}})";

std::string error(const std::string& school) {
    return messageOf([&] { shoalOf(school, hunter); });
}

}  // namespace

TEST_CASE("A school keeps what its file says", "[school]") {
    const Scene scene = shoalOf(R"("radius": 0.6, "blind": 0.25, "separationRadius": 0.3, "separation": 5,
        "alignment": 3, "cohesion": 1, "slowest": 0.2, "cruise": 0.3, "fastest": 0.9, "acceleration": 6,
        "turn": 5, "steepest": 0.5, "reaction": 0.2, "bend": 0.8, "beat": 0.5, "fins": 0.5, "wander": 0.1,
        "depth": [1, 2], "depthStrength": 3, "walls": 0.4, "look": 0.7,
        "home": {"center": [1, 2, 3], "radius": 4, "strength": 5},
        "flees": [{"group": "hunter", "radius": 3, "strength": 7}])",
                                hunter);
    const School& school = *scene.groups[0].school;
    const double numbers[] = {
        school.radius,   school.blind,    school.separationRadius, school.separation,    school.alignment,
        school.cohesion, school.slowest,  school.cruise,           school.fastest,       school.acceleration,
        school.turn,     school.steepest, school.reaction,         school.bend,          school.beat,
        school.fins,     school.wander,   school.depth->x,         school.depth->y,      school.depthStrength,
        school.walls,    school.look,     school.home->radius,     school.home->strength};
    const double expected[] = {0.6, 0.25, 0.3, 5,   3,   1, 0.2, 0.3, 0.9, 6,   5, 0.5,
                               0.2, 0.8,  0.5, 0.5, 0.1, 1, 2,   3,   0.4, 0.7, 4, 5};
    for (size_t i = 0; i < std::size(expected); ++i) {
        INFO("number " << i);
        CHECK(numbers[i] == expected[i]);
    }
    CHECK(school.home->center == glm::dvec3(1, 2, 3));
    REQUIRE(school.flees.size() == 1);
    CHECK(school.flees[0].radius == 3);
    CHECK(school.flees[0].strength == 7);
    CHECK_FALSE(scene.groups[1].school);
}

TEST_CASE("What a school cannot be is refused where it stands", "[school]") {
    CHECK_THAT(error(R"("radius": 0)"), Contains("$.groups[0].school.radius"));
    CHECK_THAT(error(R"("radius": -1)"), Contains("expected"));
    CHECK_THAT(error(R"("slowest": 2)"), Contains("slowest <= cruise <= fastest") && Contains("school"));
    CHECK_THAT(error(R"("cruise": 2)"), Contains("slowest <= cruise <= fastest"));
    CHECK_THAT(error(R"("radius": 0.3, "separationRadius": 0.4)"), Contains("separationRadius"));
    CHECK_THAT(error(R"("depth": [2, 1])"), Contains("depth"));
    CHECK_THAT(error(R"("blind": 4)"), Contains("$.groups[0].school.blind"));
    CHECK_THAT(error(R"("reaction": 0)"), Contains("$.groups[0].school.reaction"));
    CHECK_THAT(error(R"("turn": 0)"), Contains("$.groups[0].school.turn"));
    CHECK_THAT(error(R"("cohesoin": 1)"), Contains("cohesion"));
    CHECK_THAT(error(R"("home": {"radius": 1})"), Contains("center"));
    CHECK_THAT(error(R"("flees": [{"group": "hutner"}])"),
               Contains("no group \"hutner\"") && Contains("hunter") && Contains("flees[0]"));
    CHECK_THAT(error(R"("hunts": [{"group": "fry"}])"), Contains("cannot hunt itself"));
    CHECK_THAT(error(R"("hunts": [{"group": "hunter"}], "flees": [{"group": "hunter"}])"),
               Contains("cannot both flee and hunt"));
    CHECK_THAT(error(R"("flees": [{"group": "hunter", "radius": 0}])"), Contains("flees[0].radius"));
    std::string nine;
    for (int i = 0; i < 9; ++i)
        nine += std::string(i ? ", " : "") + R"({"group": "hunter"})";
    CHECK_THAT(error(R"("flees": [)" + nine + "]"), Contains("at most 8"));
}

TEST_CASE("Muscles of several frequencies share a period that their clock counts round", "[school]") {
    CHECK(commonPeriod({}) == 0);
    CHECK(commonPeriod({0}) == 0);
    CHECK(commonPeriod({4}) == 0.25);
    CHECK(commonPeriod({0.5, 0, 0.75}) == Approx(4));
    CHECK(commonPeriod({1.1, 1.3}) == Approx(10));
    CHECK(commonPeriod({0.001}) == 1000);
    const double odd = commonPeriod({1, std::sqrt(2.0), std::sqrt(3.0)});
    CHECK(odd <= 256);
    CHECK(std::abs(std::remainder(odd * std::sqrt(2.0), 1.0)) < 0.05);
    CHECK(std::abs(std::remainder(odd * std::sqrt(3.0), 1.0)) < 0.05);
}

TEST_CASE("Every one that is looked for has a grid; keys and entries of grids do not overlap", "[school]") {
    const Plan plan = compile(shoalOf(R"("flees": [{"group": "hunter"}])", hunter));
    const SchoolPlan& school = plan.school;
    REQUIRE(school.members.size() == 1);
    REQUIRE(school.grids.size() == 2);
    CHECK(school.bodyCount == 7);
    CHECK(school.entries == 7);
    CHECK(school.grids[1].firstEntry == 5);
    CHECK(school.grids[0].keys == 8);
    CHECK(school.grids[1].firstKey == 8);
    CHECK(plan.groups[0].musclePeriod == 0.25);
    CHECK_THAT(explain(plan, {}), Contains("flees \"hunter\" within 2 m"));
    CHECK(compile(parseScene(
                      R"({"format": "shoal-scene-1", "groups": [{"molecule": "fry.json", "count": 1,
                          "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]})",
                      SHOAL_SOURCE_DIR "/molecules/s.json"))
              .school.grids.empty());
}

TEST_CASE("The springs of a fry know how bending stretches them", "[school]") {
    const Molecule fry = readMolecule(SHOAL_SOURCE_DIR "/molecules/fry.json");
    // by the closed form of a body bent into a circle
    const double curvature = 0.1;
    const auto bent = [&](const glm::dvec3& p) {
        const double r = 1 / curvature, angle = p.z / r;
        return glm::dvec3(r - (r - p.x) * std::cos(angle), p.y, (r - p.x) * std::sin(angle));
    };
    int muscles = 0;
    for (const Spring& spring : fry.springs) {
        if (!spring.actuation) {
            CHECK(bendOf(fry, spring) == 0);
            continue;
        }
        const double length = glm::distance(bent(fry.vertices[size_t(spring.a)].position),
                                            bent(fry.vertices[size_t(spring.b)].position));
        CHECK(length / fry.restLength(spring) - 1 == Approx(curvature * bendOf(fry, spring)).margin(2e-6));
        muscles += bendOf(fry, spring) != 0;
    }
    CHECK(muscles > 30);
}

TEST_CASE("Muscles beyond what a spring or the step follows are told", "[school]") {
    const auto told = [](const Scene& scene) {
        std::vector<Warning> warnings;
        checkMuscles(scene, scene.groups[0], warnings);
        std::string out;
        for (const Warning& warning : warnings)
            out += warning.message + "\n";
        return out;
    };
    Scene scene = shoalOf("");
    CHECK(told(scene).empty());
    scene.groups[0].school->beat = 0.01;
    CHECK_THAT(told(scene),
               Contains("substeps of a frame would follow it") && Contains("its spring follows"));
    scene.groups[0].school->beat = 0.4;
    scene.groups[0].school->bend = 3;
    scene.groups[0].molecule.springs[20].actuation = Actuation{0.8, 4, 0};
    CHECK_THAT(told(scene), Contains("may turn inside out"));
    for (Spring& spring : scene.groups[0].molecule.springs)
        if (spring.actuation) spring.actuation->amplitude = 0.98;
    CHECK_THROWS_AS(told(scene), Error);
}

TEST_CASE("The rules of a school hold their limits, and none is NaN", "[school]") {
    using namespace shoal::shader;
    const auto finite = [](const glm::vec3& v) { return std::isfinite(v.x + v.y + v.z); };
    const glm::vec3 d(0.3f, -0.1f, 0.2f);
    CHECK(length(awayFrom(d, 1)) == Approx(1 - length(d)));
    CHECK(length(awayFrom(d, 0.3f)) == 0);
    CHECK(awayFrom(glm::vec3(0), 1) == glm::vec3(0));
    CHECK(length(atMost(d, 0.1f)) == Approx(0.1f));
    CHECK(atMost(d, 9) == d);
    CHECK(length(inTurn(d * 9.0f, d * 9.0f, 1)) == Approx(1));
    CHECK(inTurn(d, d, 9) == d + d);
    CHECK(isSeen({0, 0, -1}, {0, 0, 1}, 0.9f) == false);
    CHECK(isSeen({1, 0, -1}, {0, 0, 1}, 0.9f));
    CHECK(isSeen({0, 0, 0}, {0, 0, 1}, 0.9f));
    CHECK(backIntoBall({3, 0, 0}, {0, 0, 0}, 1) == glm::vec3(-2, 0, 0));
    CHECK(backIntoBall({0, 0, 0}, {0, 0, 0}, 1) == glm::vec3(0));
    CHECK(backInto({3, 0, 0}, glm::vec3(-1), glm::vec3(1)) == glm::vec3(-2, 0, 0));
    CHECK(courseOf({0, 0, 0}, {1, 0, 0}, 0.5f) == glm::vec3(1, 0, 0));
    for (const glm::vec3& wanted : {glm::vec3(0, 9, 0), glm::vec3(0, -9, 0), glm::vec3(1, 9, 1)}) {
        const glm::vec3 course = courseOf(wanted, {1, 0, 0}, 0.5f);
        CHECK(finite(course));
        CHECK(length(course) == Approx(1));
        CHECK(std::abs(course.y) < 0.5001f * std::hypot(course.x, course.z));
    }
    const glm::vec3 up(0, 1, 0), ahead(0, 0, 1), behind = glm::normalize(glm::vec3(0.1f, -0.2f, -1));
    CHECK(length(turnBetween(ahead, -ahead) - up * 3.14159265f) < 1e-5);
    CHECK(length(turnBetween(ahead, {1, 0, 0}) - up * 1.5707963f) < 1e-5);
    CHECK(turnBetween(ahead, ahead) == glm::vec3(0));
    CHECK(finite(turnBetween(up, ahead)));
    glm::vec3 turned = glm::normalize(glm::vec3(0, 0.3f, 1));
    const float steepest = turned.y;
    for (int i = 0; i < 1000; ++i) {
        turned = glm::normalize(turned + 0.01f * glm::cross(turnBetween(turned, behind), turned));
        CHECK(std::abs(turned.y) < steepest + 1e-4f);  // it does not turn over the top
    }
    CHECK(glm::distance(turned, behind) < 1e-3f);
    for (int i = 0; i < 100; ++i)
        CHECK(std::abs(wanderOf(float(i) * 0.7f, 0.1f, 0.5f, 0.9f)) <= 1);
}
