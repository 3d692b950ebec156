// The fused path in all the ways it can be run: in place, a lane a molecule or a vertex, split into parts.
#include <algorithm>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "render/renderer.h"
#include "simulate/fused.h"
#include "support/catch.h"

namespace shoal {

using test::FeatureScene;

namespace {

// Contact, pins that are released, directional drag, muscles and fields at once.
Scene fullScene(Molecule molecule, int count, FieldSampling sampling, SolverKind solver) {
    molecule.vertices[0].pinned = molecule.vertices.size() > 1;
    test::addMuscles(molecule, 0.1);
    Scene scene = test::swarm(molecule, count, solver, {0, 1.5, 0});
    scene.gravity = {0, -9.81, 0};
    scene.solver.fieldSampling = sampling;
    scene.fields = {test::everyField()[1], test::everyField()[2]};
    scene.colliders = {test::everyCollider()[0], test::everyCollider()[1]};
    Group& group = scene.groups[0];
    group.drag = {3, 0.8};
    group.release = Release{{}, 1.5, 0};
    group.phaseSpread = 3;
    test::setStableSubsteps(scene);
    return scene;
}

}  // namespace

TEST_CASE("in place the bits are the same, from half the memory", "[fused]") {
    if (!test::canFuse()) return;
    for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
        for (const int count : {1, 67, 1030}) {
            const Scene scene = fullScene(test::shippedMolecule("leaf"), count, FieldSampling::vertexSubstep,
                                          SolverKind::leapfrog);
            const Plan plan = compile(scene);
            Simulation two(testContext(), plan, {.path = Path::fused, .lanes = lanes});
            Simulation one(testContext(), plan, {.path = Path::fused, .inPlace = true, .lanes = lanes});
            const BufferLayout layout{9};
            CHECK(two.stateBytes() - one.stateBytes() ==
                  layout.padded(size_t(count)) * size_t(layout.stateElements()) * 16);
            test::run(two, 9);
            test::run(one, 9);
            INFO(name(lanes) << ", " << count << " molecules");
            CHECK(one.hash() == two.hash());
            CHECK(one.snapshot(0).normals == two.snapshot(0).normals);
            const SavedState saved = one.save();
            one.restart();
            one.load(saved);
            CHECK(one.save().groups == two.save().groups);
            test::run(two, 3);
            test::run(one, 3);
            CHECK(one.hash() == two.hash());
        }
    }
}

TEST_CASE("a group in parts moves and looks like one that is whole", "[fused][render]") {
    if (!test::canFuse()) return;
    gpu::Context& context = testContext();
    for (const Lanes lanes : {Lanes::molecule, Lanes::vertex}) {
        for (const bool inPlace : {false, true}) {
            INFO(name(lanes) << (inPlace ? ", in place" : ""));
            Scene scene = fullScene(test::shippedMolecule("leaf"), 1030, FieldSampling::vertexSubstep,
                                    SolverKind::euler);
            scene.camera.eye = {0, 2, 7};
            scene.camera.target = {0, 1.5, 0};
            const Plan plan = compile(scene);
            Simulation whole(context, plan, {.path = Path::fused, .inPlace = inPlace, .lanes = lanes});
            REQUIRE(whole.state().buffers->front().parts().size() == 1);

            Simulation split(context, plan,
                             {.path = Path::fused, .inPlace = inPlace, .lanes = lanes, .largestPart = 300});
            const std::vector<GroupBuffers::Part>& parts = split.state().buffers->front().parts();
            REQUIRE(parts.size() >= 3);
            int covered = 0;
            for (const GroupBuffers::Part& part : parts) {
                CHECK(part.first == covered);
                CHECK(part.first % BufferLayout::block == 0);
                CHECK(part.count <= 300);
                covered += part.count;
            }
            CHECK(covered == 1030);

            CHECK(split.snapshot(0).normals == whole.snapshot(0).normals);
            for (int frame = 0; frame < 12; ++frame) {
                split.frame();
                whole.frame();
            }
            CHECK(split.save().groups[0] == whole.save().groups[0]);
            CHECK(split.snapshot(0).normals == whole.snapshot(0).normals);

            RenderOptions size;
            size.width = 160, size.height = 120;
            Renderer renderer(context, scene, plan, size);
            renderer.draw(whole.state(), View::fromCamera(scene.camera));
            const Image expected = renderer.capture();
            renderer.draw(split.state(), View::fromCamera(scene.camera));
            CHECK(renderer.capture().pixels == expected.pixels);
            renderer.draw(Simulation(context, plan, {.path = Path::fused}).state(),
                          View::fromCamera(scene.camera));
            CHECK(renderer.capture().pixels != expected.pixels);
        }
    }
}

}  // namespace shoal
