// A scene compiles to what it needs: passes, buffers and shader text.
#include <algorithm>

#include "compile/generate.h"
#include "compile/pack.h"
#include "compile/passes.h"
#include "compile/path.h"
#include "compile/plan.h"
#include "molecule/analysis.h"
#include "molecule/molecule_file.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;

namespace {

Scene sceneWith(const std::string& molecule, int count = 3) {
    Scene scene;
    Group group;
    group.molecule = readMolecule(SHOAL_SOURCE_DIR "/molecules/" + molecule + ".json");
    group.count = count;
    scene.groups.push_back(group);
    return scene;
}

Field field(FieldShape shape) {
    Field out;
    out.shape = std::move(shape);
    return out;
}

Collider collider(ColliderShape shape) {
    Collider out;
    out.shape = std::move(shape);
    return out;
}

// "records restore | advect collide restore | normals": the passes at a frame's start, a substep, its end.
std::string passes(const Plan& plan) {
    std::string out;
    using When = Pass::When;
    for (const When when : {When::frameStart, When::substep, When::frameEnd}) {
        if (when != When::frameStart) out += "|";
        for (const Pass& pass : passesOf(plan.groups.at(0)))
            if (pass.when == when)
                out += std::string(out.empty() || out.back() == '|' ? "" : " ") + name(pass.kind);
    }
    return out;
}

}  // namespace

TEST_CASE("a bare point is only advected", "[plan]") {
    const Plan plan = compile(sceneWith("point"));
    CHECK(passes(plan) == "records|advect|watch");
    CHECK(plan.fields.source.empty());
    CHECK(plan.colliders.source.empty());
}

TEST_CASE("each need brings its pass and no other", "[plan]") {
    Scene scene = sceneWith("quad");
    CHECK(passes(compile(scene)) == "records restore|advect restore|normals watch");

    scene.solver.kind = SolverKind::euler;
    CHECK(passes(compile(scene)) == "records|restore advect|normals watch");
    scene.solver.kind = SolverKind::leapfrog;

    scene.colliders.push_back(collider(PlaneCollider{}));
    CHECK(passes(compile(scene)) == "records restore|advect collide restore|normals watch");
    scene.groups[0].collide = false;
    CHECK(passes(compile(scene)) == "records restore|advect restore|normals watch");
    CHECK(compile(scene).colliders.source.empty());

    scene.groups[0].drag = {4, 1};
    CHECK(passes(compile(scene)) == "records restore|normals advect restore|normals watch");
    scene.groups[0].drag = {2, 2};
    CHECK(passes(compile(scene)) == "records restore|advect restore|normals watch");
}

TEST_CASE("fields are read only where there is drag", "[plan]") {
    Scene scene = sceneWith("quad");
    scene.fields.push_back(field(UniformField{{1, 0, 0}}));
    CHECK_FALSE(compile(scene).groups[0].needs.fields);
    CHECK(compile(scene).fields.source.empty());
    scene.groups[0].drag = {1, 1};
    const Plan plan = compile(scene);
    CHECK(plan.groups[0].needs.fields);
    CHECK(plan.fields.source.find("fieldParameters[0].xyz") != std::string::npos);
}

TEST_CASE("what hangs on pins for good keeps no records pass", "[plan]") {
    Scene scene = sceneWith("leaf");
    CHECK(passes(compile(scene)) == "restore|advect restore|normals watch");
    scene.groups[0].release = Release{0.1, std::nullopt, 0};
    CHECK(passes(compile(scene)) == "records restore|advect restore|normals watch");
    scene.groups[0].release.reset();
    scene.groups[0].held = false;
    const Plan plan = compile(scene);
    CHECK(passes(plan) == "records restore|advect restore|normals watch");
    CHECK_FALSE(plan.groups[0].needs.pins);
}

TEST_CASE("changing a number changes no shader text", "[plan]") {
    Scene scene = sceneWith("quad");
    scene.groups[0].drag = {1, 1};
    GustField gust;
    scene.fields.push_back(field(gust));
    scene.fields.push_back(field(VortexField{}));
    scene.fields[1].box = Box{};
    scene.colliders.push_back(collider(SphereCollider{}));
    const Plan before = compile(scene);
    gust.speed = 9;
    gust.direction = {0, 0, 1};
    scene.fields[0] = field(gust);
    scene.fields[0].weight = 0.25;
    scene.fields[1].box = Box{glm::dvec3(-7), glm::dvec3(7)};
    scene.colliders[0] = collider(SphereCollider{{1, 2, 3}, 4});
    scene.colliders[0].restitution = 0.9;
    const Plan after = compile(scene);
    CHECK(after.fields.source == before.fields.source);
    CHECK(after.colliders.source == before.colliders.source);
    CHECK(after.fields.parameters != before.fields.parameters);
    CHECK(after.groups[0].colliderParameters != before.groups[0].colliderParameters);
}

TEST_CASE("groups share the textures of passes row by row", "[plan]") {
    Scene scene = sceneWith("quad", 1025);
    scene.groups.push_back(sceneWith("point", 5).groups[0]);
    const size_t rows = 4 * 2 + 1, recordRows = 2 + 1;
    // two sides of positions, velocities and accelerations, and normals; two sides of records, and constants
    CHECK(stateBytes(compile(scene), Path::pingPong, true) == (7 * rows + 3 * recordRows) * 1024 * 16);
}

TEST_CASE("start positions are the placed vertices, relative to an anchor on the lattice", "[plan]") {
    Scene scene = sceneWith("quad", 2);
    Group& group = scene.groups[0];
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    group.place.items = {{{1e5, 2, -3}, {1, 0, 0, 0}, 2}, {{0.03, 0, 0}, {1, 0, 0, 0}, 1}};
    const Plan plan = compile(scene);
    for (size_t m = 0; m < 2; ++m) {
        const GroupState& start = plan.groups[0].start;
        const glm::vec3 cells = start.anchors[m] * 16.0f;
        CHECK(cells == glm::floor(cells));
        for (size_t v = 0; v < 4; ++v) {
            const glm::dvec3 world = glm::dvec3(start.anchors[m]) + glm::dvec3(start.positions[m * 4 + v]);
            const Placement::Item& item = group.place.items[m];
            const glm::dvec3 expected = item.position + item.scale * group.molecule.vertices[v].position;
            // half a float's spacing within 1 m of the anchor, however far the anchor is
            CHECK(glm::length(world - expected) < 1e-7);
        }
    }
}

TEST_CASE("a point of the scene is a lattice point and a rest, or all rest where a float will do", "[plan]") {
    const auto isFloat = [](double x) { return double(float(x)) == x; };
    for (const double x : {0.1, -3.3, 20.7, 512.0, -1e5})
        CHECK_FALSE(splitPoint({x, 0, 0}).isFar());
    for (const double x : {100.3, -100000.3, 1e6 + 0.7}) {
        const SplitPoint split = splitPoint({0.2, x, 0});
        CAPTURE(x);
        CHECK(isFloat(split.lattice.y));
        CHECK(split.lattice + split.rest == glm::dvec3(0.2, x, 0));
        CHECK(std::abs(split.rest.y) <= 1 / 32.0);
    }
}

TEST_CASE("topology lists each spring at both ends and each triangle at its corners", "[plan]") {
    const Scene scene = sceneWith("fish", 1);
    const Plan plan = compile(scene);
    const Molecule& fish = scene.groups[0].molecule;
    int springs = 0, triangles = 0;
    for (size_t v = 0; v < fish.vertices.size(); ++v) {
        const glm::vec4 spans = plan.topology[v];
        springs += int(spans.y);
        triangles += int(spans.w);
        for (int i = 0; i < int(spans.y); ++i) {
            const glm::vec4 spring = plan.topology[size_t(spans.x) + 2 * size_t(i)];
            const double length =
                glm::length(fish.vertices[v].position - fish.vertices[size_t(spring.x)].position);
            CHECK(double(spring.w) == Approx(length).epsilon(1e-6));
        }
    }
    CHECK(springs == 2 * 96);
    CHECK(triangles == 3 * int(fish.triangles.size()));
}

TEST_CASE("a step beyond the solver's limit is refused with the substeps that would do", "[plan]") {
    Scene scene = sceneWith("quad");
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 1;
    for (Spring& spring : scene.groups[0].molecule.springs)
        spring.stiffness = 1e6;
    const std::string message = messageOf([&] { compile(scene); });
    REQUIRE_THAT(message, Catch::Contains("use at least "));
    scene.solver.substeps = std::stoi(message.substr(message.find("use at least ") + 13));
    CHECK_NOTHROW(compile(scene));
    --scene.solver.substeps;
    CHECK_THROWS_AS(compile(scene), Error);
}

TEST_CASE("sliders ask for the substeps that a stiffer or more damped molecule needs", "[plan]") {
    const Plan plan = compile(sceneWith("quad"));
    CHECK(substepsNeeded(plan, 1.0 / 60, 1, 1, 1, 4) == 4);
    const int stiff = substepsNeeded(plan, 1.0 / 60, 100, 1, 1, 4);
    CHECK(stiff > 4);
    CHECK(1.0 / 60 / stiff * 10 <= plan.groups[0].stableStep);
}

TEST_CASE("more than the textures hold is refused with what would fit", "[plan]") {
    PathLimits limits;
    limits.maxTextureSize = 2048;
    const Plan large = compile(sceneWith("fish", 100000)), small = compile(sceneWith("fish", 80000));
    CHECK_THAT(messageOf([&] { choosePath(large, Path::pingPong, limits); }),
               Catch::Contains("147 MiB") && Catch::Contains("at most 87040"));
    CHECK(choosePath(small, Path::pingPong, limits).path == Path::pingPong);
    CHECK(choosePath(large, Path::automatic, limits).path == Path::fused);
    limits.compute = false;
    CHECK(choosePath(large, Path::automatic, limits).path == Path::fragments);
    limits.maxTextureSize = 64;  // molecules are texels in fragments
    CHECK_THAT(messageOf([&] { choosePath(large, Path::fragments, limits); }),
               Catch::Contains("100000 molecules") && Catch::Contains("at most 65536"));
    limits.maxTextureLayers = 35;
    CHECK_THAT(messageOf([&] { choosePath(small, Path::fragments, limits); }),
               Catch::Contains("takes 36 layers") && Catch::Contains("has 35"));

    Plan fine = compile(sceneWith("fish"));
    fine.samples.resize(8 * 64 * stateWidth);
    for (const Path path : {Path::fragments, Path::pingPong})
        CHECK_THAT(messageOf([&] { choosePath(fine, path, limits); }),
                   Catch::Contains("would fit at 47 % of their resolutions"));
    limits.compute = true;
    CHECK(choosePath(fine, Path::automatic, limits).path == Path::fused);
}

TEST_CASE("a context that draws into too few textures is refused with how many it takes", "[plan]") {
    PathLimits limits;
    limits.compute = false;
    limits.targets = 4;
    Scene scene = sceneWith("quad");
    CHECK(choosePath(compile(scene), Path::automatic, limits).path == Path::fragments);
    scene.groups[0].contact = GroupContact{};
    scene.groups[0].contact->radius = 0.01;
    for (const Path path : {Path::automatic, Path::fused, Path::fragments, Path::pingPong})
        CHECK_THAT(messageOf([&] { choosePath(compile(scene), path, limits); }),
                   Catch::Contains("contact between molecules draws into 7 textures at once") &&
                       Catch::Contains("this context allows 4"));
    limits.targets = 3;
    scene.groups[0].contact.reset();
    CHECK_THAT(messageOf([&] { choosePath(compile(scene), Path::fused, limits); }),
               Catch::Contains("fragments draw into 4 textures at once; this context allows 3"));
}

TEST_CASE("a group that never moves may be larger than a lane, in fragments", "[plan]") {
    PathLimits limits;
    limits.compute = false;
    Scene scene = sceneWith("point");
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.resize(100);
    CHECK_THAT(messageOf([&] { choosePath(compile(scene), Path::fragments, limits); }),
               Catch::Contains("a lane holds at most 64"));
    for (Vertex& vertex : molecule.vertices)
        vertex.pinned = true;
    CHECK(choosePath(compile(scene), Path::automatic, limits).path == Path::fragments);
}

TEST_CASE("without compute shaders the fused path runs in fragments and says so, with the version",
          "[plan]") {
    PathLimits limits;
    limits.compute = false;
    limits.version = "3.3";
    const Plan plan = compile(sceneWith("quad"));
    const PathChoice asked = choosePath(plan, Path::fused, limits);
    CHECK(asked.path == Path::fragments);
    CHECK_THAT(asked.why, Catch::Contains("OpenGL 3.3 has no compute shaders"));
    const PathChoice choice = choosePath(plan, Path::automatic, limits);
    CHECK(choice.path == Path::fragments);
    CHECK_THAT(choice.why, Catch::Contains("OpenGL 4.3"));
}

TEST_CASE("a molecule beyond the device's shared memory is refused with the number that fits", "[plan]") {
    Scene scene = sceneWith("point");
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.resize(1400);
    PathLimits limits;
    const Plan plan = compile(scene);
    CHECK_THAT(messageOf([&] { choosePath(plan, Path::fused, limits); }),
               Catch::Contains("1400 vertices") &&
                   Catch::Contains(concat("at most ", FusedLimits::vertices(limits.maxSharedBytes))));
    CHECK(choosePath(plan, Path::automatic, limits).path == Path::pingPong);
    molecule.vertices.resize(size_t(FusedLimits::vertices(limits.maxSharedBytes)));
    CHECK(choosePath(compile(scene), Path::fused, limits).path == Path::fused);
}

TEST_CASE("the bytes of a quad on the fused path", "[plan]") {
    // 4 vertices of 6 floats, twice, and a record: 192 + 16; in place 96 + 16; normals 48 more
    const Plan plan = compile(sceneWith("quad", 1024));
    CHECK(stateBytes(plan, Path::fused, false) == 1024 * 208);
    CHECK(stateBytes(plan, Path::fused, false, true) == 1024 * 112);
    CHECK(stateBytes(plan, Path::fused, true) == 1024 * 256);
    // in fragments the record has two sides
    CHECK(stateBytes(plan, Path::fragments, true) == 1024 * 272);
}
