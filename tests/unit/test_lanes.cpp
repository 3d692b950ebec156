// The form of the fused kernel that a group takes, and what is refused because it takes too long to compile.
#include <filesystem>

#include "bench/case.h"
#include "compile/path.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;

namespace {

// Vertices in a row, each joined to its neighbours where asked for.
Molecule row(int vertices, bool sprung) {
    Molecule out;
    for (int i = 0; i < vertices; ++i)
        out.vertices.push_back({{0.1 * i, 0, 0}, {}, 1, false});
    for (int i = 1; sprung && i < vertices; ++i)
        out.springs.push_back({i - 1, i, 10, 0.1, {}, {}});
    return out;
}

// A cube with so many vertices along each edge, as stiff as a body.
Molecule block(int side) {
    Molecule out;
    for (int i = 0; i < side * side * side; ++i)
        out.vertices.push_back(
            {0.1 * glm::dvec3(i % side, i / side % side, i / (side * side)), {}, 0.01, false});
    for (int i = 0; i < int(out.vertices.size()); ++i)
        for (int j = 0; j < i; ++j)
            if (glm::distance(out.vertices[size_t(i)].position, out.vertices[size_t(j)].position) < 0.18)
                out.springs.push_back({j, i, 1e8, 1, {}, {}});
    return out;
}

Plan planOf(const Molecule& molecule, int colliders, SolverKind solver = SolverKind::leapfrog) {
    Scene scene;
    scene.solver.kind = solver;
    scene.solver.substeps = 64;
    scene.colliders.resize(size_t(colliders));
    Group group;
    group.name = "some";
    group.molecule = molecule;
    group.count = 1024;
    group.drag = {6, 1};
    group.place.kind = Placement::Kind::volume;
    group.place.box = {{-1, 0, -1}, {1, 2, 1}};
    scene.groups.push_back(group);
    return compile(scene);
}

Lanes chosen(const Plan& plan, bool software, Lanes wanted = Lanes::automatic) {
    PathLimits limits;
    limits.software = software;
    return chooseLanes(plan, plan.groups[0], wanted, limits);
}

}  // namespace

TEST_CASE(
    "a GPU takes a lane a vertex for what no lane holds well, a CPU rasteriser what it compiles in time",
    "[lanes]") {
    CHECK(chosen(planOf(row(12, true), 1), false) == Lanes::molecule);
    CHECK(chosen(planOf(row(13, true), 1), false) == Lanes::vertex);
    CHECK(chosen(planOf(row(20, true), 0), false) == Lanes::molecule);
    CHECK(chosen(planOf(row(21, true), 0), false) == Lanes::vertex);

    for (const int vertices : {1, 24, 60, 64})
        for (const int colliders : {0, 1})
            CHECK(chosen(planOf(row(vertices, true), colliders), true) == Lanes::molecule);
    CHECK(chosen(planOf(row(24, true), 2), true) == Lanes::molecule);
    CHECK(chosen(planOf(bench::cloth(6), 1), true) == Lanes::molecule);
    CHECK(chosen(planOf(row(65, false), 0), true) == Lanes::vertex);
}

TEST_CASE("a CPU rasteriser compiles for as long as the frames of the run are worth it", "[lanes]") {
    const auto chosenFor = [](Plan plan, int frames, int count) {
        plan.frames = frames;
        plan.groups[0].count = count;
        return chosen(plan, true);
    };
    const Plan quick = planOf(row(24, true), 1), slow = planOf(bench::cloth(8), 1);
    CHECK(secondsToCompile(quick, quick.groups[0]) < 5);
    CHECK(secondsToCompile(slow, slow.groups[0]) > 5);
    CHECK(chosenFor(quick, 1, 1) == Lanes::molecule);
    CHECK(chosenFor(slow, 0, 1) == Lanes::vertex);
    CHECK(chosenFor(slow, 0, 1000) == Lanes::molecule);
    CHECK(chosenFor(slow, 2, 1000) == Lanes::vertex);
    // nor where it would be refused
    const Plan lasting = planOf(row(64, true), 3);
    CHECK(chosenFor(lasting, 1000, 1000) == Lanes::vertex);
    // bodies go the same way however far they go
    Plan body = slow;
    body.groups[0].rigid = true;
    CHECK(chosenFor(body, 1000, 1000) == Lanes::vertex);
}

TEST_CASE("what a CPU rasteriser would compile for long is refused where a lane a molecule is the only form",
          "[lanes]") {
    const Plan many = planOf(row(64, true), 3);
    CHECK(chosen(many, false, Lanes::molecule) == Lanes::molecule);
    CHECK_THAT(messageOf([&] { chosen(many, true, Lanes::molecule); }),
               Catch::Contains("would take about 14 s to compile \"some\", 64 vertices and 63 springs") &&
                   Catch::Contains("leave out --lanes molecule"));
    CHECK(chosen(many, true) == Lanes::vertex);

    const Plan stiff = planOf(bench::cloth(8), 0, SolverKind::bdf2Xpbd);
    CHECK(chosen(stiff, false) == Lanes::molecule);
    CHECK_THAT(messageOf([&] { chosen(stiff, true); }),
               Catch::Contains("with bdf2-xpbd in one lane") &&
                   Catch::Contains("use bdf2-newton or an explicit solver"));
    CHECK(chosen(planOf(row(32, true), 1, SolverKind::bdf2Xpbd), true) == Lanes::molecule);
    // Fragments do not take it either: they would take even longer to compile it.
    PathLimits rasteriser;
    rasteriser.software = true;
    CHECK_THAT(messageOf([&] { choosePath(stiff, Path::automatic, rasteriser); }),
               Catch::Contains("no path can run this scene: a CPU rasteriser would take about"));

    // fragments, which a CPU rasteriser takes only where it is told to, compile whatever fits
    PathLimits limits;
    limits.software = true;
    CHECK_NOTHROW(checkLane(stiff, stiff.groups[0], limits));
}

TEST_CASE("auto takes no implicit solver that a CPU rasteriser would refuse to compile", "[lanes][solvers]") {
    Scene scene;
    Group group;
    group.name = "cloth";
    group.molecule = bench::cloth(8);
    group.count = 1;
    scene.groups.push_back(group);
    const auto choice = [&](double stiffer) {
        scene.groups[0].stiffness = stiffer;
        return compile(scene);
    };
    // stable at rest, not for every shape that the molecule may take
    double stiffer = 1;
    while (choice(stiffer).groups[0].solverWhy.starts_with("the substep resolves"))
        stiffer *= 1.05;
    const Plan plan = choice(stiffer);
    CHECK(plan.groups[0].solver == SolverKind::leapfrog);
    CHECK_THAT(plan.groups[0].solverWhy, Catch::StartsWith("a CPU rasteriser would take too long"));
    CHECK_NOTHROW(chosen(plan, true));
    // a smaller cloth compiles in time
    scene.groups[0].molecule = bench::cloth(4);
    stiffer = 1;
    while (choice(stiffer).groups[0].solver == SolverKind::leapfrog)
        stiffer *= 1.05;
    CHECK(chosen(choice(stiffer), true) == Lanes::molecule);
    // no explicit solver is stable: a GPU runs it
    scene.groups[0].molecule = bench::cloth(8);
    const Plan stiff = choice(1e5);
    CHECK(stiff.groups[0].solver == SolverKind::bdf2Xpbd);
    CHECK(chosen(stiff, false) == Lanes::molecule);
    CHECK_THROWS_AS(chosen(stiff, true), Error);
}

TEST_CASE("bdf2-newton has a lane a vertex, and auto takes it where a lane does not hold a stiff molecule",
          "[lanes][solvers]") {
    for (const bool software : {false, true}) {
        const Plan plan = planOf(row(24, true), 2, SolverKind::bdf2Newton);
        CHECK(chosen(plan, software) == Lanes::vertex);
        CHECK(chosen(plan, software, Lanes::vertex) == Lanes::vertex);
        CHECK_THAT(messageOf([&] { chosen(plan, software, Lanes::molecule); }),
                   Catch::Contains("bdf2-newton") && Catch::Contains("leave out --lanes molecule"));
    }
    Scene scene;
    scene.groups.resize(1);
    scene.groups[0].name = "cloth";
    scene.groups[0].molecule = bench::cloth(12);
    scene.groups[0].count = 1;
    scene.groups[0].stiffness = 1e5;
    const Plan large = compile(scene);
    CHECK(large.groups[0].solver == SolverKind::bdf2Newton);
    CHECK_THAT(large.groups[0].solverWhy, Catch::StartsWith("the springs are stiff"));
    CHECK(choosePath(large, Path::automatic, {}).path == Path::fused);
    PathLimits old;
    old.compute = false;
    old.version = "3.3";
    CHECK_THAT(messageOf([&] { choosePath(large, Path::automatic, old); }),
               Catch::Contains("bdf2-newton") && Catch::Contains("compute shaders alone"));
    CHECK_THAT(messageOf([&] { choosePath(large, Path::pingPong, {}); }),
               Catch::Contains("bdf2-newton") && Catch::Contains("needs the fused path"));
    // stiff bodies beside a collider
    CHECK_THAT(messageOf([&] { planOf(block(2), 1, SolverKind::bdf2Newton); }),
               Catch::Contains("\"some\" is a stiff body") && Catch::Contains(": use bdf2-xpbd"));
    const Plan body = planOf(block(5), 1, SolverKind::bdf2Newton);
    REQUIRE(body.warnings.size() == 2);
    CHECK_THAT(body.warnings.back().message, Catch::Contains("\"some\" is a stiff body"));
    CHECK(planOf(block(2), 0, SolverKind::bdf2Newton).groups[0].rigid);
    // more than a workgroup holds
    CHECK_THAT(messageOf([&] { chosen(planOf(row(1400, true), 0, SolverKind::bdf2Newton), false); }),
               Catch::Contains("a workgroup holds at most 1365"));
    // springs that the substep resolves
    scene.groups[0].stiffness = 1;
    CHECK(compile(scene).groups[0].solver == SolverKind::leapfrog);
}

TEST_CASE("molecules that no path holds are refused by their vertices alone, as their plan is", "[lanes]") {
    PathLimits limits;
    limits.maxTextureSize = 2048;
    const auto scene = [](int vertices) {
        Scene out;
        Group group;
        group.name = "long";
        group.molecule = row(vertices, false);
        group.count = 1;
        out.groups.push_back(group);
        return out;
    };
    for (const auto& [path, most] : {std::pair(Path::automatic, 2048), std::pair(Path::pingPong, 2048),
                                     std::pair(Path::fused, 1365), std::pair(Path::fragments, 170)}) {
        INFO(name(path));
        CHECK_NOTHROW(checkVertices(scene(most), path, limits));
        CHECK_THAT(messageOf([&] { checkVertices(scene(most + 1), path, limits); }),
                   Catch::Contains(concat("\"long\" has ", most + 1, " vertices")) &&
                       Catch::Contains(concat("more than ", most, " on this device")));
        CHECK_THROWS_AS(choosePath(compile(scene(most + 1)), path, limits), Error);
    }
    CHECK_NOTHROW(choosePath(compile(scene(2048)), Path::automatic, limits));
    limits.compute = false;
    CHECK_THROWS_AS(checkVertices(scene(171), Path::fused, limits), Error);
}

TEST_CASE(
    "every scene that ships takes a lane a molecule on a CPU rasteriser, runs in fragments, and strains no "
    "spring",
    "[lanes][strain]") {
    int groups = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SHOAL_SOURCE_DIR "/models")) {
        if (!entry.path().string().ends_with(".scene.json")) continue;
        Scene scene = readScene(entry.path().string());
        for (Group& group : scene.groups)
            group.count = std::min(group.count, 100);
        const Plan plan = compile(scene);
        for (const Warning& warning : plan.warnings)
            CHECK_THAT(warning.message, !Catch::Contains("strains the springs"));
        PathLimits limits;
        limits.software = true;
        for (const GroupPlan& group : plan.groups) {
            INFO(entry.path().filename() << ", " << group.name << ", " << group.vertexCount << " vertices, "
                                         << secondsToCompile(plan, group) << " s");
            if (group.isStill()) continue;
            CHECK(chooseLanes(plan, group, Lanes::automatic, limits) == Lanes::molecule);
            CHECK_NOTHROW(checkLane(plan, group, limits));
            ++groups;
        }
    }
    CHECK(groups > 20);
}
