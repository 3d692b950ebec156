// Stacks of soft solids: with long contact steps they shake, of which the plan warns, and with the steps that
// it names they rest.
#include <algorithm>

#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using glm::dvec3;

namespace {

// 10 cm and 0.1 kg, a spring between any two corners.
Molecule cube(double stiffness) {
    Molecule out;
    out.name = "cube";
    for (int i = 0; i < 8; ++i)
        out.vertices.push_back(
            {.position = 0.1 * (dvec3(i & 1, i >> 1 & 1, i >> 2 & 1) - 0.5), .mass = 0.0125});
    for (int a = 0; a < 8; ++a)
        for (int b = a + 1; b < 8; ++b)
            out.springs.push_back({a, b, stiffness, 2, {}, {}});
    return out;
}

// So many of them, let fall by a centimetre, with a gap between two.
Scene stack(double stiffness, SolverKind solver, int substeps, int levels = 5, double gap = 0.01) {
    std::vector<Item> items;
    for (int i = 0; i < levels; ++i)
        items.push_back(at({0, 0.09 + (0.16 + gap) * i, 0}));
    Scene scene = sceneOf(cube(stiffness), solver, items);
    Group& group = scene.groups[0];
    group.contact.emplace().radius = 0.03;
    group.restitution = 0.1;
    group.friction = 0.5;
    scene.gravity = {0, -9.81, 0};
    Collider& floor = scene.colliders.emplace_back();
    floor.shape = PlaneCollider{};
    floor.thickness = 0.03;
    setSteps(scene, 1 / 60.0, substeps);
    return scene;
}

// The steps that a warning asks for; 0: there is none.
int stepsToldOf(const Plan& plan) {
    for (const Warning& warning : plan.warnings) {
        const size_t place = warning.message.find("of at least ");
        if (warning.message.find("they shake") != std::string::npos && place != std::string::npos)
            return std::atoi(warning.message.c_str() + place + 12);
    }
    return 0;
}

std::string warningsOf(const Plan& plan) {
    std::string out;
    for (const Warning& warning : plan.warnings)
        out += warning.message + "\n";
    return out;
}

// m/s, of any vertex in the fifth second.
double fastestOf(const Scene& scene) {
    Simulation simulation(testContext(), compile(scene), {.drawn = false});
    run(simulation, 270);
    double out = 0;
    for (int i = 0; i < 30; ++i) {
        run(simulation, 1);
        for (const dvec3& v : simulation.snapshot(0).velocities)
            out = std::max(out, glm::length(v));
    }
    return out;
}

}  // namespace

TEST_CASE("a stack of soft cubes rests with the contact steps that a warning names", "[molecule contact]") {
    struct Stack {
        double stiffness;
        SolverKind solver;
        int substeps;
    };
    const Stack each =
        GENERATE(Stack{400, SolverKind::bdf2Xpbd, 4}, Stack{1600, SolverKind::xpbd, 12},
                 Stack{400, SolverKind::leapfrog, 24}, Stack{400, SolverKind::bdf2Corotated, 4});
    if (!testContext().info().computeShaders && each.solver != SolverKind::xpbd) return;  // a minute
    CAPTURE(each.stiffness, name(each.solver), each.substeps);
    Scene scene = stack(each.stiffness, each.solver, each.substeps);
    if (each.solver == SolverKind::leapfrog) scene.contact.steps = 4;
    const int told = stepsToldOf(compile(scene));
    REQUIRE(told > scene.contact.steps);
    CHECK(fastestOf(scene) > 0.01);
    setSteps(scene, 1 / 60.0, std::max(told, each.substeps));
    if (scene.contact.steps) scene.contact.steps = told;
    CHECK(stepsToldOf(compile(scene)) == 0);
    CHECK(fastestOf(scene) < 1e-3);
}

TEST_CASE("a tower of twenty cubes rests with what a warning names", "[molecule contact]") {
    if (!testContext().info().computeShaders) return;  // a minute
    using Catch::Contains;
    const std::string tower = "a tower of 20 molecules",
                      steps = "falls: \"substeps\" of at least 8 instead of 4";
    Scene scene = stack(1e6, SolverKind::bdf2Xpbd, 4, 20, 0);
    CHECK_THAT(warningsOf(compile(scene)), Contains(tower) && Contains(steps));
    setSteps(scene, 1 / 60.0, 8);
    scene.contact.iterations = 8;
    CHECK_THAT(warningsOf(compile(scene)),
               Contains(tower) && Contains("falls: \"iterations\" of at least 30 instead of 8 hold it"));
    CHECK(fastestOf(scene) > 1e-3);
    scene.contact.iterations = 0;
    CHECK(compile(scene).contact.settings.iterations == 30);
    CHECK(warningsOf(compile(scene)).empty());
    CHECK(fastestOf(scene) < 5e-4);
    CHECK(fastestOf(stack(40000, SolverKind::bdf2Xpbd, 16, 20, 0)) < 5e-4);
    // far apart they do not stand on one another
    CHECK_THAT(warningsOf(compile(stack(1e6, SolverKind::bdf2Xpbd, 4, 20, 0.2))), !Contains(tower));
}

TEST_CASE("rigid cubes, sheets and what floats are not warned of as soft", "[molecule contact]") {
    CHECK(stepsToldOf(compile(stack(40000, SolverKind::bdf2Xpbd, 4))) == 0);
    Scene scene = stack(400, SolverKind::bdf2Xpbd, 4);
    scene.gravity = {};
    CHECK(stepsToldOf(compile(scene)) == 0);
    scene = stack(400, SolverKind::bdf2Xpbd, 4);
    scene.groups[0].molecule = shippedMolecule("leaf");
    CHECK(stepsToldOf(compile(scene)) == 0);
}
