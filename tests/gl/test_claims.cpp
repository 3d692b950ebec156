// What --error claims of random scenes, against the double-precision reference of all their molecules.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/random_scene.h"
#include "measure/calibrate.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/shapes.h"

namespace shoal {

using namespace test;
using namespace measure;

namespace {

struct Found {
    double rms = 0, worst = 0;
    int above = 0, unknown = 0;
};

// Each molecule by a reference of its own, so that one that has none leaves the others theirs.
Found found(const Scene& scene, const Calibration& claim, const AccuracyDevice& device, double seconds) {
    MethodRunner runner(scene, claim.method, device);
    runner.set({claim.substeps, 1});
    runner.restart();
    const std::vector<Snapshot> starts = runner.snapshots();
    runner.run(int(std::lround(claim.duration * scene.frameRate)));
    const std::vector<Snapshot> ends = runner.snapshots();
    Found out;
    for (int m = 0; m < randomMolecules; ++m) {
        ExactEnds exact(scene, runner.simulation().plan(), starts, claim.duration, device.cores, {{0, m}});
        const Settled settled = exact.solve(0.01 * claim.target, seconds);
        if (settled != Settled::yes && exact.error() > 0.1 * claim.target) {
            ++out.unknown;
            continue;
        }
        const double error = exact.errorOf(ends).total;
        out.rms += error * error;
        out.worst = std::max(out.worst, error);
        out.above += error > claim.target;
    }
    out.rms = std::sqrt(out.rms / std::max(1, randomMolecules - out.unknown));
    return out;
}

struct Checked {
    std::optional<Calibration> claim;
    std::string refusal;
    Found truth;
};

// `seconds`: of the search.
Checked check(uint64_t seed, double error, std::optional<double> seconds = {}) {
    const Scene scene = randomScene(seed);
    const AccuracyDevice device{.context = &testContext(), .cores = 2, .path = testPath()};
    CalibrationOptions options;
    options.error = error;
    options.seconds = seconds;
    Checked out;
    try {
        out.claim = calibrate(scene, options, device);
        out.truth = found(scene, *out.claim, device, seconds ? 5 : 600);
    } catch (const Error& refusal) {
        out.refusal = refusal.message();
    }
    return out;
}

}  // namespace

TEST_CASE("what --error claims of a scene holds for all of its molecules", "[claims]") {
    for (const uint64_t seed : {5u, 6u, 8u, 9u, 12u, 14u}) {
        constexpr double error = 1e-3;
        const Checked checked = check(seed, error);
        CAPTURE(seed, checked.refusal);
        REQUIRE(checked.claim);
        CHECK(checked.claim->sample.molecules == randomMolecules);
        CHECK(checked.truth.unknown == 0);
        CHECK(checked.truth.above == 0);
        CHECK(checked.truth.rms < error);
    }
}

// A row of the report, which docs/accuracy/claims.py asks for: SHOAL_CLAIM is "SEED ERROR".
TEST_CASE("what --error claims of a random scene", "[.claims-table]") {
    const char* asked = std::getenv("SHOAL_CLAIM");
    REQUIRE(asked);
    std::istringstream words(asked);
    uint64_t seed = 0;
    double error = 0;
    REQUIRE(words >> seed >> error);
    const auto [claim, refusal, truth] = check(seed, error, 60);
    if (claim)
        std::printf("claim,%s,%d,%g,%g,%d,%d,%g,%g,%d,%d\n", name(claim->method.solver), claim->substeps,
                    claim->duration, claim->error, claim->sample.above, claim->sample.unknown, truth.rms,
                    truth.worst, truth.above, truth.unknown);
    else
        std::printf("refusal,%s\n", refusal.c_str());
}

TEST_CASE("a step is measured as a run takes it, whatever was measured before", "[claims][fused]") {
    // contact treats it as a body within a frame, and not within a 64th of it
    Scene scene;
    scene.frameRate = 5;
    scene.gravity = {0, -9.81, 0};
    scene.colliders.push_back(
        {.name = "floor", .shape = PlaneCollider{{0, -1, 0}, {0, 1, 0}}, .restitution = 0.5});
    Group& group = scene.groups.emplace_back();
    group.molecule = leaf(1e4, 5);
    group.count = 1;
    group.velocity = {0.3, -3, 0};
    const AccuracyDevice device{.context = &testContext(), .path = testPath()};
    const Method method{SolverKind::bdf2Xpbd, FieldSampling::vertexSubstep};
    const auto endAfter = [&](const std::vector<int>& steps) {
        MethodRunner runner(scene, method, device);
        for (const int substeps : steps) {
            runner.set({substeps, 1});
            runner.run(2);
        }
        return runner.snapshots().front().positions;
    };
    const std::vector<glm::dvec3> fine = endAfter({64});
    CHECK(endAfter({1, 64}) == fine);
    CHECK(endAfter({1, 64, 1}) == endAfter({1}));
    CHECK(endAfter({1}) != fine);
}

}  // namespace shoal
