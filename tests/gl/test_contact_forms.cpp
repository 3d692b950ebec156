// Contact in fragments is that of compute shaders, with all that either form has: spheres on triangles,
// within a molecule, and walls within the response.
#include <algorithm>
#include <functional>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "gpu/frame_record.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Sheets that fall on one another, on marbles and into a corner.
Scene heap(bool triangles, bool self) {
    Scene scene = swarm(sheet(3, 3, false), 60, SolverKind::leapfrog, {0, 1, 0});
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].held = false;
    scene.groups[0].place.box = {{-0.8, 0.3, -0.8}, {0.8, 1.5, 0.8}};
    scene.groups[0].contact.emplace().radius = 0.06;
    scene.groups[0].contact->triangles = triangles;
    scene.groups[0].contact->self = self;
    Group marbles = scene.groups[0];
    marbles.name = "marbles";
    marbles.molecule = point(0.1);
    marbles.count = 80;
    marbles.contact->triangles = marbles.contact->self = false;
    scene.groups.push_back(marbles);
    PlaneCollider ground;
    scene.colliders.emplace_back().shape = ground;
    ground.normal = glm::normalize(glm::dvec3(1, 1, 0));
    ground.point = {-0.6, 0, 0};
    scene.colliders.emplace_back().shape = ground;
    scene.contact.steps = 2;
    setSteps(scene, 1.0 / 60, 8);
    return scene;
}

// With tetrahedra in place of its sheets, so stiff that they answer as rigid bodies.
void makeStiff(Scene& scene) {
    scene.solver.kind = SolverKind::bdf2Xpbd;
    Molecule& molecule = scene.groups[0].molecule;
    molecule = leaf(1e6, 0);
    const glm::dvec3 corners[] = {{0, 0, 0}, {0.5, 0, 0}, {0.25, 0, 0.43}, {0.25, 0.4, 0.14}};
    for (size_t i = 0; i < 4; ++i)
        molecule.vertices[i].position = corners[i];
}

}  // namespace

TEST_CASE("compute shaders and fragments have the same contact", "[molecule contact][agreement]") {
    if (!canFuse()) return;
    for (const bool triangles : {false, true}) {
        for (const bool self : {false, true}) {
            CAPTURE(triangles, self);
            const Plan plan = compile(heap(triangles, self));
            Simulation compute(testContext(), plan, {.drawn = false, .path = Path::fused});
            Simulation fragments(testContext(), plan, {.drawn = false, .path = Path::fragments});
            size_t most = 0;
            for (int i = 0; i < 40; ++i) {
                compute.frame();
                if (i % 13 != 0) continue;  // from the same state, one frame
                const SavedState saved = compute.save();
                fragments.load(saved);
                CHECK((fragments.save().contacts == saved.contacts));
                compute.frame();
                fragments.frame();
                CHECK(compute.contact()->found() == fragments.contact()->found());
                most = std::max(most, fragments.contact()->found().size());
                for (size_t g = 0; g < 2; ++g) {
                    const Snapshot a = compute.snapshot(g), b = fragments.snapshot(g);
                    double position = 0, velocity = 0;
                    for (size_t v = 0; v < a.positions.size(); ++v) {
                        position = std::max(position, glm::distance(a.positions[v], b.positions[v]));
                        velocity = std::max(velocity, glm::distance(a.velocities[v], b.velocities[v]));
                    }
                    CAPTURE(i, g);
                    CHECK(position < 1e-5);
                    CHECK(velocity < 1e-3);
                }
            }
            CHECK(most > 100);
        }
    }
}

TEST_CASE("contact has the same bits whether keys are sorted or counted in their cells",
          "[molecule contact][agreement]") {
    if (!canFuse()) return;
    for (const ContactSearch search :
         {ContactSearch::exact, ContactSearch::single, ContactSearch::staggered}) {
        for (const double size : {0.8, 0.02}) {  // the small one: all in a few cells, and lists overflow
            CAPTURE(int(search), size);
            Scene scene = heap(true, true);
            scene.contact.search = search;
            scene.groups[0].place.box = {{-size, 0.3, -size}, {size, 0.3 + size, size}};
            scene.groups[1].place.box = scene.groups[0].place.box;
            const Plan plan = compile(scene);
            uint64_t hashes[2];
            for (const bool asOnGpu : {false, true}) {
                Simulation simulation(testContext(), plan,
                                      {.drawn = false, .path = Path::fused, .asOnGpu = asOnGpu});
                for (int i = 0; i < 6; ++i)
                    simulation.frame();
                CHECK_FALSE(simulation.contact()->found().empty());
                hashes[asOnGpu] = simulation.hash();
            }
            CHECK(hashes[0] == hashes[1]);
        }
    }
}

TEST_CASE("a contact step takes as many dispatches when nothing touches as when all do",
          "[molecule contact]") {
    if (!canFuse()) return;
    for (const bool asOnGpu : {false, true}) {
        int dispatches[2];
        for (const bool touch : {false, true}) {
            Scene scene = swarm(point(0.1), 200, SolverKind::leapfrog, {0, 1, 0});
            scene.groups[0].held = false;
            const double half = touch ? 0.02 : 100;
            scene.groups[0].place.box = {glm::dvec3(-half), glm::dvec3(half)};
            scene.groups[0].contact.emplace().radius = 0.02;
            Simulation simulation(testContext(), compile(scene),
                                  {.drawn = false, .path = Path::fused, .asOnGpu = asOnGpu});
            simulation.frame();
            CHECK(simulation.contact()->found().empty() != touch);
            if (touch) CHECK(simulation.contact()->dropped() > 0);
            dispatches[touch] = simulation.contact()->dispatches();
        }
        CHECK(dispatches[0] == dispatches[1]);
        if (asOnGpu) CHECK(dispatches[1] == 24);
    }
}

// Storage blocks of a compute shader, and textures of any: what the compiler kept of both.
TEST_CASE("no pass of contact takes more storage blocks or textures than OpenGL promises",
          "[molecule contact]") {
    if (!canFuse()) return;
    size_t mostBlocks = 0, mostTextures = 0;
    for (const bool rests : {false, true}) {
        for (const bool stiff : {false, true}) {
            Scene scene = heap(true, true);
            if (stiff) makeStiff(scene);
            scene.contact.fastest = 20.0;
            if (rests) scene.contact.rest = 0.01;
            const Plan plan = compile(scene);
            CHECK(plan.groups[0].rigid == stiff);
            for (const auto& [path, asOnGpu] : {std::pair(Path::fused, false), std::pair(Path::fused, true),
                                                std::pair(Path::fragments, false)}) {
                if (rests && path == Path::fragments) continue;
                Simulation simulation(testContext(), plan,
                                      {.drawn = false, .path = path, .asOnGpu = asOnGpu});
                const gpu::FrameRecord record;
                simulation.frame();
                CHECK(record.rows().size() > 10);
                for (const gpu::PassRow& row : record.rows()) {
                    CAPTURE(rests, stiff, asOnGpu, row.pass);
                    const auto isWritten = [&row](const std::string& name) {
                        return std::find(row.writes.begin(), row.writes.end(), name) != row.writes.end();
                    };
                    const auto textures =
                        std::count_if(row.reads.begin(), row.reads.end(), std::not_fn(isWritten));
                    CHECK(textures <= 16);
                    mostTextures = std::max(mostTextures, size_t(textures));
                    if (path == Path::fragments) continue;
                    CHECK(row.writes.size() <= 8);
                    mostBlocks = std::max(mostBlocks, row.writes.size());
                }
            }
        }
    }
    CHECK(mostBlocks > 4);
    CHECK(mostTextures > 8);
}
