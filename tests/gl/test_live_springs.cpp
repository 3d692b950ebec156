// Springs whose numbers are data (CompileOptions::liveSprings) move as those that are compiled in, and change
// while they run.
#include <algorithm>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Simulation on(const Plan& plan) {
    return Simulation(testContext(), plan, {.path = Path::fused});
}

Scene swimmers(SolverKind solver) {
    Molecule fish = shippedMolecule("fish");
    addMuscles(fish, 0.1);
    Scene scene = swarm(fish, 19, solver, {0, 2, 0});
    scene.gravity = {0, -1, 0};
    scene.groups[0].phaseSpread = 2;
    setStableSubsteps(scene);
    return scene;
}

// m: the largest distance between the same vertices of two runs.
double apart(const Simulation& a, const Simulation& b) {
    const Snapshot one = a.snapshot(0), other = b.snapshot(0);
    double out = 0;
    for (size_t i = 0; i < one.positions.size(); ++i)
        out = std::max(out, glm::length(one.positions[i] - other.positions[i]));
    return out;
}

}  // namespace

TEST_CASE("live springs move as springs that are compiled in, and change while they run", "[fused][live]") {
    if (!canFuse()) return;
    for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::verlet, SolverKind::bdf2Xpbd}) {
        INFO(name(solver));
        Scene scene = swimmers(solver);
        Simulation plain = on(compile(scene)), live = on(compile(scene, {.liveSprings = true}));
        test::run(plain, 20);
        test::run(live, 20);
        CHECK(apart(plain, live) < 2e-5);

        // softer, so that the step stays stable; other muscles, other rest lengths
        SavedState middle = plain.save();
        middle.step = 0;  // other springs: history begins anew
        Molecule& fish = scene.groups[0].molecule;
        for (size_t i = 0; i < fish.springs.size(); ++i) {
            Spring& spring = fish.springs[i];
            spring.stiffness *= 0.3 + 0.002 * double(i);
            spring.damping *= 0.5;
            if (i % 7 == 0) spring.restLength = 1.05 * fish.restLength(spring);
            if (spring.actuation) spring.actuation->frequency *= 1.5;
        }
        Simulation fresh = on(compile(scene));
        fresh.load(middle);
        live.load(middle);
        REQUIRE(live.changeSprings(0, fish));
        test::run(plain, 10);
        test::run(fresh, 10);
        test::run(live, 10);
        CHECK(apart(fresh, live) < 2e-5);
        CHECK(apart(plain, live) > 1e-3);
    }
}

TEST_CASE("a school bends alike with live springs and with those that are compiled in",
          "[fused][live][school]") {
    if (!canFuse()) return;
    Molecule fry = shippedMolecule("fry");
    addMuscles(fry, 0.2);
    Scene scene = swarm(fry, 20, SolverKind::leapfrog, {0, 2, 0});
    scene.solver.substeps = 5;
    scene.groups[0].drag = {40, 1};
    School& school = scene.groups[0].school.emplace();
    school.bend = 1.5;
    school.home = SchoolHome{{}, {0, 2, 0}, 0.1, 20};
    Simulation plain = on(compile(scene)), live = on(compile(scene, {.liveSprings = true}));
    test::run(plain, 20);
    test::run(live, 20);
    CHECK(apart(plain, live) < 2e-5);
}

TEST_CASE("springs that are compiled in, and other springs, are not changed", "[fused][live]") {
    if (!canFuse()) return;
    const Scene scene = swimmers(SolverKind::leapfrog);
    Molecule fish = scene.groups[0].molecule;
    Simulation plain = on(compile(scene)), live = on(compile(scene, {.liveSprings = true}));
    CHECK_FALSE(plain.changeSprings(0, fish));
    fish.springs.pop_back();
    CHECK_FALSE(live.changeSprings(0, fish));
}
