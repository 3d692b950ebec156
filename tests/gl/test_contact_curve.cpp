// What contact between molecules gets wrong, by its substeps and iterations.
#include "gl/marbles.h"
#include "measure/calibrate.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using namespace measure;

namespace {

// Five marbles on one another, on a plane.
Scene stack() {
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 5; ++i)
        places.emplace_back(0, 0.05 * (2 * i + 1), 0);
    Scene out = marbles(places, 0.05);
    out.frameRate = 60;
    out.solver.substeps = 4;
    out.gravity = {0, -9.81, 0};
    out.colliders.push_back({.name = "floor", .shape = PlaneCollider{}});
    return out;
}

ContactCurve measured(const Scene& scene, const ContactCurveOptions& options) {
    return measureContact(scene, options, {.context = &testContext(), .path = testPath()});
}

}  // namespace

TEST_CASE("a stack overlaps and gains less with more substeps and iterations", "[contact-curve]") {
    const ContactCurve curve =
        measured(stack(), {.duration = 0.5, .substeps = {2, 16}, .iterations = {2, 32}, .rounds = 2});
    REQUIRE(curve.points.size() == 4);
    CHECK((curve.molecules == 5 && curve.spheres == 5 && curve.solver == "leapfrog"));
    for (const ContactPoint& point : curve.points) {
        CAPTURE(point.substeps, point.iterations);
        REQUIRE(point.outcome == Outcome::measured);
        CHECK(point.steps == point.substeps);
        CHECK(point.time.samples == 2);
        CHECK(point.errors.largestOverlap >= point.errors.overlap);
        // both sides of a contact compute it from the same numbers
        REQUIRE(point.errors.momentum);
        CHECK(*point.errors.momentum < 1e-6);
        CHECK_FALSE(point.scenes);
    }
    const ContactPoint &least = curve.points.front(), &most = curve.points.back();
    CHECK(most.contacts == Approx(4).margin(0.1));
    CHECK(most.errors.overlap < 0.1 * least.errors.overlap);
    CHECK(*most.errors.energyGiven < 0.1 * *least.errors.energyGiven);
    CHECK((most.front &&
           std::any_of(curve.points.begin(), curve.points.end(),
                       [&](const ContactPoint& point) { return &point != &most && point.front; })));
}

TEST_CASE("contact's curve goes around what the scene says", "[contact-curve]") {
    Scene scene = stack();
    scene.fields.emplace_back().shape = UniformField{{1, 0, 0}};
    scene.contact.iterations = 8;
    const ContactCurve curve = measured(scene, {.duration = 0.05, .rounds = 1});
    CHECK(curve.points.size() == 20);
    CHECK(curve.driven == "fields");
    int own = 0;
    for (const ContactPoint& point : curve.points) {
        own += point.scenes;
        if (point.scenes) CHECK((point.substeps == 4 && point.iterations == 8));
        CHECK_FALSE(point.errors.energyGiven);
    }
    CHECK(own == 1);
    const ContactCurve hurried = measured(scene, {.duration = 0.05, .rounds = 1, .seconds = 1e-3});
    CHECK(hurried.notes.front() == "--seconds 0.001 is too short for 19 of 20 points");
    scene.groups[0].contact.reset();
    CHECK_THROWS_WITH(measured(scene, {}), Catch::Contains("there is no contact to measure"));
}

TEST_CASE("an error that is asked for of molecules that touch chooses their contact", "[contact-curve]") {
    const AccuracyDevice device{.context = &testContext(), .path = testPath()};
    CalibrationOptions options;
    options.duration = 0.3;
    options.error = 0.05;
    options.substeps = 4;
    Scene scene = stack();
    const Calibration found = calibrate(scene, options, device);
    REQUIRE(found.contact);
    CHECK(found.error == found.contact->errors.overlap);
    CHECK(found.error <= 0.05);
    apply(found, scene);
    CHECK(scene.solver.substeps == 4);
    CHECK(scene.contact.iterations == found.contact->iterations);
    options.error = 1e-6;
    CHECK_THROWS_WITH(
        calibrate(scene, options, device),
        Catch::Contains("--error 1e-06 is out of reach for contact between molecules: the nearest is 4"));
    options.solvers = {SolverKind::euler};
    CHECK_THROWS_WITH(calibrate(scene, options, device), Catch::Contains("remove --solver"));
    CHECK_THROWS_WITH(measureAccuracy(scene, {}, device),
                      Catch::Contains("the reference knows no contact between molecules"));
}

}  // namespace shoal
