// The paths agree: from the same state, one frame on each. And each repeats itself to the bit.
#include <algorithm>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "simulate/fused.h"
#include "support/catch.h"

namespace shoal {

using test::FeatureScene;

namespace {

bool runsInFragments(const Plan& plan) {
    return test::takes(plan, Path::fragments);
}

// With compute shaders where there are some, else in fragments, if they can.
Path fusedPath(const Plan& plan) {
    if (testContext().info().computeShaders) return Path::fused;
    return runsInFragments(plan) ? Path::fragments : Path::pingPong;
}

// Contact in fragments, whose programs take long to compile, is repeated where it is what runs.
std::vector<Path> pathsOf(const Plan& plan) {
    std::vector<Path> out = {Path::pingPong};
    const bool compute = testContext().info().computeShaders;
    if (compute) out.push_back(Path::fused);
    if (runsInFragments(plan) && !(compute && plan.contact.any())) out.push_back(Path::fragments);
    return out;
}

Simulation on(Path path, const Plan& plan) {
    return Simulation(testContext(), plan, {.path = path});
}

}  // namespace

TEST_CASE("the fused path and passes agree on every scene", "[fused][agreement][long]") {
    std::vector<FeatureScene> scenes = test::shippedScenes(100);
    REQUIRE(scenes.size() >= 2);
    for (FeatureScene& one : test::featureScenes())
        scenes.push_back(std::move(one));
    int contacts = 0, releases = 0;
    for (const FeatureScene& one : scenes) {
        test::Agreement agreement(one.scene, {.path = fusedPath(compile(one.scene))},
                                  {.path = Path::pingPong});
        for (const int frame : {0, 60}) {
            const test::Comparison c = agreement.at(frame);
            UNSCOPED_INFO(one.name << ", frame " << frame << ": " << text(c));
            CHECK(c.wrong == 0);
            CHECK(c.excepted < 0.05 * c.molecules);
            CHECK(c.normal < test::Agreement::normalTolerance);
            contacts += c.contacts;
            releases += c.releases;
        }
    }
    CHECK(contacts > 100);
    CHECK(releases > 50);
}

// Below 4.3 the test above runs in fragments.
TEST_CASE("compute shaders and fragments agree with every solver", "[fused][agreement][long]") {
    if (!test::canFuse()) return;
    std::vector<FeatureScene> scenes = test::shippedScenes(100);
    for (const Solver& solver : solvers()) {
        FeatureScene one = test::featureScenes().back();  // of two groups, every field, two colliders
        one.scene.groups[0].release = Release{{}, 1.0, 0};
        one.name += concat(", ", solver.name);
        one.scene.solver.kind = solver.kind;
        test::setStableSubsteps(one.scene);
        scenes.push_back(std::move(one));
    }
    int compared = 0;
    for (const FeatureScene& one : scenes) {
        if (!runsInFragments(compile(one.scene))) continue;
        ++compared;
        test::Agreement agreement(one.scene, {.path = Path::fused}, {.path = Path::fragments});
        for (const int frame : {0, 60}) {
            const test::Comparison c = agreement.at(frame);
            UNSCOPED_INFO(one.name << ", frame " << frame << ": " << text(c));
            CHECK(c.wrong == 0);
            CHECK(c.excepted < 0.05 * c.molecules);
            CHECK(c.normal < test::Agreement::normalTolerance);
        }
    }
    CHECK(compared > 9);
}

TEST_CASE("every scene that ships runs in fragments where there is no OpenGL 4.3", "[agreement]") {
    PathLimits limits;
    limits.version = "3.3";
    limits.compute = false;
    for (const bool fusedOnly : {false, true})
        for (const FeatureScene& one : test::shippedScenes(40, fusedOnly)) {
            INFO(one.name);
            const Plan plan = compile(one.scene);
            for (const Path path : {Path::automatic, Path::fused, Path::fragments})
                CHECK(choosePath(plan, path, limits).path == Path::fragments);
        }
}

// Contact, births and schools: everything that passes lack.
TEST_CASE("compute shaders and fragments agree on every scene with contact, births or schools",
          "[fused][agreement][long]") {
    if (!test::canFuse()) return;
    const std::vector<FeatureScene> scenes = test::shippedScenes(40, true);
    CHECK(scenes.size() >= 8);
    for (const FeatureScene& one : scenes) {
        INFO(one.name);
        Scene scene = one.scene;
        scene.contact.rest.reset();  // in fragments nothing rests
        const Plan plan = compile(scene);
        Simulation compute = on(Path::fused, plan), fragments = on(Path::fragments, plan);
        for (const int frame : {0, 30, 60}) {
            test::run(compute, frame - compute.frames());
            fragments.load(compute.save());
            compute.frame();
            fragments.frame();
            const SavedState a = compute.save(), b = fragments.save();
            for (size_t g = 0; g < plan.groups.size(); ++g) {
                const GroupPlan& group = plan.groups[g];
                double furthest = 0;
                for (size_t i = 0; i < a.groups[g].positions.size(); ++i) {
                    const size_t m = i / size_t(group.vertexCount);
                    if (group.life && !(a.groups[g].lives[m].y > 0)) continue;
                    const glm::dvec3 anchors = a.groups[g].anchors[m] - b.groups[g].anchors[m];
                    const glm::dvec3 places = a.groups[g].positions[i] - b.groups[g].positions[i];
                    furthest = std::max(furthest, glm::length(anchors + places) / group.size);
                }
                INFO(group.name << ", frame " << frame);
                // Contact passes on in its iterations what compilers round otherwise: 2.2e-5 was seen with
                // Mesa 25, and 3.4e-5 on a GPU.
                CHECK(furthest < (plan.contact.any() ? 10 : 1) * test::Agreement::tolerance);
                CHECK(a.groups[g].seeds == b.groups[g].seeds);
                CHECK(a.groups[g].totals == b.groups[g].totals);
            }
        }
    }
}

TEST_CASE("a run repeats itself, starts again and goes on from a saved state, bit for bit",
          "[fused][agreement]") {
    for (const FeatureScene& one : test::featureScenes()) {
        // what differs between scenes here is the layout and what is carried on: a share of them will do
        if (one.name.find("field") == 0 || one.name.find("euler") != std::string::npos) continue;
        const Plan plan = compile(one.scene);
        for (const Path path : pathsOf(plan)) {
            INFO(one.name << " on the " << name(path) << " path");
            Simulation first = on(path, plan), other = on(path, plan);
            test::run(first, 4);
            const SavedState middle = first.save();
            test::run(first, 3);
            const uint64_t end = first.hash();

            test::run(other, 7);
            CHECK(other.hash() == end);
            other.restart();
            CHECK(other.hash() != end);
            test::run(other, 7);
            CHECK(other.hash() == end);

            other.load(middle);
            CHECK(other.frames() == 4);
            CHECK(other.time() == middle.time);
            CHECK(other.save().groups == middle.groups);
            for (size_t g = 0; g < plan.groups.size(); ++g)
                CHECK(other.snapshot(g).normals.size() == plan.groups[g].start.positions.size());
            test::run(other, 3);
            CHECK(other.hash() == end);
            CHECK(other.time() == first.time());
        }
    }
}

TEST_CASE("a state crosses from one path to the others and back without a bit lost", "[fused][agreement]") {
    for (const int count : {1, 31, 64, 1030}) {
        Scene scene = test::swarm(test::sheet(3, 3, true), count, SolverKind::leapfrog, {1e5, 2, 0});
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].release = Release{{}, 5.0, 0};
        test::setStableSubsteps(scene);
        const Plan plan = compile(scene);
        Simulation fused = on(fusedPath(plan), plan);
        CHECK(fused.save().groups[0] == plan.groups[0].start);
        test::run(fused, 5);
        const SavedState saved = fused.save();
        const auto released = std::count(saved.groups[0].released.begin(), saved.groups[0].released.end(), 1);
        if (count > 1) CHECK((released > 0 && released < count));
        for (const Path path : {Path::pingPong, Path::fragments}) {
            Simulation other = on(path, plan);
            CHECK(other.save().groups[0] == plan.groups[0].start);
            other.load(saved);
            CHECK(other.save().groups == saved.groups);
            CHECK(other.hash() == fused.hash());
            fused.restart();
            fused.load(other.save());
            CHECK(fused.save().groups == saved.groups);
            CHECK(fused.frames() == 5);
        }
    }
}

}  // namespace shoal
