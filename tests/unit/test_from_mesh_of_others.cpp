// Molecules from meshes as others make them: of several parts, with holes, doubled walls, a few triangles, or
// limbs that only a cage holds.
#include <algorithm>
#include <filesystem>
#include <map>

#include "geometry/close_holes.h"
#include "geometry/doubled_walls.h"
#include "molecule/check.h"
#include "molecule/molecule_file.h"
#include "support/meshes.h"
#include "support/solids.h"
#include "unit/from_mesh.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("what makes no molecule is refused with its reason", "[from-mesh]") {
    const Mesh mesh = club(8, 9);
    FromMesh options;
    const auto with = [&](auto&& change) {
        options = {};
        change(options);
        return refused(mesh, options);
    };
    CHECK(with([](FromMesh& o) { o.vertices = 500; }).find("takes too long to make: at most 227") !=
          std::string::npos);
    CHECK(with([](FromMesh& o) { o.rings = 57; }).find("at most 227, which are 56 rings") !=
          std::string::npos);
    CHECK(with([](FromMesh& o) { o.vertices = 3; }) == "vertices: expected at least 4, found 3");
    CHECK(with([](FromMesh& o) { o.rings = 1; }) == "rings: expected at least 2, found 1");
    CHECK(with([](FromMesh& o) { o.size = -1; }).find("size: expected a number above 0") !=
          std::string::npos);
    CHECK(with([](FromMesh& o) { o.damping = 5; }).find("damping: expected a ratio from 0 to 2") !=
          std::string::npos);
    CHECK(with([](FromMesh& o) { o.material = "flush"; }).find("did you mean \"flesh\"") !=
          std::string::npos);
    CHECK(with([](FromMesh& o) { o.mass = o.density = 1; }).find("either") != std::string::npos);
    CHECK(with([](FromMesh& o) { o.modulus = o.frequency = 5; }) ==
          "frequency: expected either a frequency or a modulus, found both");
    CHECK(with([](FromMesh& o) { o.thickness = o.frequency = 0.1; }) ==
          "frequency: expected either a frequency or a thickness, found both");
    CHECK(with([](FromMesh& o) { o.modulus = 0; }).find("modulus: expected a number above 0") == 0);
    CHECK(with([](FromMesh& o) { o.thickness = 1e-3; }).find("a body is as thick as it is") == 0);
    Mesh point = square(0);
    CHECK(refused(point, {}).find("in one place") != std::string::npos);
    options = {};
    options.rings = 3;
    CHECK(refused(square(1), options) == "rings go around a body; this mesh is flat");
}

TEST_CASE("separate parts and meshes of few vertices hold together", "[from-mesh]") {
    Mesh tubes;
    addTube(tubes, "a", {0, 0, 0}, 0.1, 1, 12, 6);
    addTube(tubes, "b", {0.5, 0, 0.1}, 0.1, 1, 12, 6);
    addTube(tubes, "c", {0.2, 0, 0.6}, 0.1, 1, 12, 6);
    completeMesh(tubes);
    const MadeMolecule out = made(tubes);
    CHECK(out.molecule.vertices.size() <= 24);
    checkBraced(out.molecule);
    Mesh few = square(0.1);
    const MadeMolecule quad = made(few);
    CHECK(quad.molecule.vertices.size() == 24);  // four could hardly bend
    CHECK(quad.molecule.skin.vertices.size() >= 96);
    CHECK(analyse(quad.molecule, false).zeroModes == 0);
    checkBraced(quad.molecule);
    FromMesh asIs;
    asIs.vertices = 8;
    CHECK(made(few, asIs).molecule.vertices.size() == 8);
    asIs.vertices = 6;  // the mesh has more than half of them
    CHECK(made(few, asIs).molecule.vertices.size() == 4);
}

TEST_CASE("small holes are closed to make a body, and the skin keeps them", "[from-mesh]") {
    Mesh tube;
    addTube(tube, "a", {0, 0, 0}, 0.1, 1, 12, 6);
    completeMesh(tube);
    REQUIRE(examineSurface(tube).closed());
    const double volume = examineSurface(tube).volume;
    Mesh holed = tube;
    // a triangle of the wall, and two beside each other
    for (const size_t t : {70, 41, 40})
        holed.triangles.erase(holed.triangles.begin() + std::ptrdiff_t(t));
    holed.objects = {{"a", 0, int(holed.triangles.size())}};
    holed.parts.clear();
    completeMesh(holed);
    REQUIRE(!examineSurface(holed).closed());
    const MadeMolecule out = made(holed);
    CHECK(out.solid);
    CHECK(out.volume == Approx(volume).epsilon(0.05));
    CHECK(out.molecule.skin.triangles.size() == holed.triangles.size());
    CHECK_THAT(out.notes.front(), Catch::Contains("closed"));

    // without its end it is a cup, and stays one
    const glm::dvec3 extent = tube.high - tube.low;
    const int axis = extent.x > std::max(extent.y, extent.z) ? 0 : extent.y > extent.z ? 1 : 2;
    Mesh cup = tube;
    std::erase_if(cup.triangles, [&](const glm::ivec3& t) {
        const auto at = [&](int corner) { return cup.positions[size_t(corner)][axis]; };
        return std::max({at(t.x), at(t.y), at(t.z)}) > tube.low[axis] + 0.9 * extent[axis];
    });
    cup.objects = {{"a", 0, int(cup.triangles.size())}};
    cup.parts.clear();
    completeMesh(cup);
    REQUIRE(examineSurface(cup).borders > 0);
    CHECK(!made(cup).solid);
    CHECK(closeHoles(cup, 1) == 1);
    CHECK(examineSurface(cup).closed());
}

TEST_CASE("walls that are there twice, or inside, count once", "[from-mesh]") {
    const auto ball = [](double radius, bool inwards = false, const glm::dvec3& middle = glm::dvec3(0)) {
        Mesh out;
        addSphere(out, middle, radius, 16, 12);
        for (glm::ivec3& t : out.triangles)
            if (inwards) std::swap(t.y, t.z);
        return out;
    };
    const auto sheet = [](double height, bool turned = false) {  // 1 m x 0.6 m, bent
        Mesh out;
        std::vector<glm::dvec3> p;
        std::vector<glm::ivec3> t;
        for (int i = 0; i < 9 * 9; ++i) {
            const double x = i % 9 / 8.0 - 0.5, z = i / 9 / 8.0 - 0.5;
            p.emplace_back(x, height + 0.3 * x * x, 0.6 * z);
        }
        for (int i = 0; i < 8 * 8; ++i) {
            const int a = i / 8 * 9 + i % 8;
            t.emplace_back(a, a + 10, a + 1);
            t.emplace_back(a, a + 9, a + 10);
        }
        for (glm::ivec3& one : t)
            if (turned) std::swap(one.y, one.z);
        addTriangles(out, "sheet", p, t);
        return out;
    };
    const auto together = [](Mesh a, const Mesh& b) {
        addTriangles(a, "other", b.positions, b.triangles);
        completeMesh(a);
        return a;
    };
    struct Case {
        const char* name;
        Mesh mesh;
        size_t doubled;
    };
    const size_t inBall = ball(1).triangles.size(), inSheet = sheet(0).triangles.size();
    const Case cases[] = {
        {"a ball twice", together(ball(1), ball(1)), inBall},
        {"a ball within a ball", together(ball(0.9), ball(1)), inBall},
        {"a hollow ball", together(ball(1), ball(0.9, true)), 0},
        {"two balls that overlap", together(ball(1), ball(0.5, false, {0.8, 0, 0})), 0},
        {"two balls apart", together(ball(1), ball(0.5, false, {3, 0, 0})), 0},
        {"a sheet with a back", together(sheet(0), sheet(0, true)), inSheet},
        {"a sheet with a back close to it", together(sheet(0), sheet(-0.002, true)), inSheet},
        {"two sheets", together(sheet(0), sheet(-0.1, true)), 0},
        {"a sheet within a ball", together(sheet(0), ball(1)), inSheet},
    };
    for (const Case& one : cases) {
        INFO(one.name);
        const std::vector<char> doubled = doubledWalls(one.mesh);
        CHECK(size_t(std::count(doubled.begin(), doubled.end(), 1)) == one.doubled);
    }
    // The mass and the shape are those of one wall, the skin is all of it.
    Mesh alone = ball(1);
    completeMesh(alone);
    const MadeMolecule once = made(alone), twice = made(cases[1].mesh);
    CHECK(twice.volume == Approx(once.volume).epsilon(1e-9));
    CHECK(twice.molecule.springs.size() == once.molecule.springs.size());
    CHECK(twice.molecule.skin.triangles.size() == 2 * inBall);
    CHECK_THAT(twice.notes.front(), Catch::Contains("lie on others or within the shape"));
    Mesh thin = sheet(0);
    completeMesh(thin);
    CHECK(made(cases[5].mesh).area == Approx(made(thin).area));
    CHECK(made(cases[6].mesh).area == Approx(made(thin).area).epsilon(1e-3));
}

TEST_CASE("no part of a skin is far from what is simulated", "[from-mesh]") {
    // a ball with eight legs of few triangles, whose ends a simplified surface loses
    Mesh spider;
    addSphere(spider, {0, 0, 0}, 0.12, 12, 8);
    for (int i = 0; i < 8; ++i) {
        const double turn = (i + 0.5) * std::numbers::pi / 4;
        const glm::dvec3 way(std::cos(turn), 0, std::sin(turn)), across(-way.z, 0, way.x);
        std::vector<glm::dvec3> p;
        std::vector<glm::ivec3> t;
        for (int k = 0; k < 4; ++k)
            for (const double side : {-0.01, 0.01})
                p.push_back((0.11 + 0.1 * k) * way + side * across);
        for (int k = 0; k < 3; ++k) {
            t.emplace_back(2 * k, 2 * k + 1, 2 * k + 3);
            t.emplace_back(2 * k, 2 * k + 3, 2 * k + 2);
        }
        addTriangles(spider, concat("leg ", i), p, t);
    }
    completeMesh(spider);
    const MadeMolecule out = made(spider);
    double furthest = 0;
    for (const SkinVertex& vertex : out.molecule.skin.vertices) {
        double nearest = 1e300;
        for (const glm::dvec3& place : restOf(out.molecule))
            nearest = std::min(nearest, glm::distance(vertex.position, place));
        furthest = std::max(furthest, nearest);
    }
    CHECK(out.skinReach == Approx(furthest));
    CHECK(furthest < 0.25 * glm::length(out.extent));
}

TEST_CASE("a few triangles become a molecule of numbers, or are refused", "[from-mesh]") {
    struct Case {
        const char* name;
        std::vector<glm::dvec3> positions;
        std::vector<glm::ivec3> triangles;
        bool made;
    };
    const double far = 40;
    std::vector<Case> cases = {
        {"two triangles", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, true},
        {"two triangles beside vertices of none",
         {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 3, 2}, {5, 0, 1}},
         {{0, 1, 2}, {1, 3, 2}},
         true},
        {"one triangle beside triangles without area",
         {{0, 1, 0}, {0, 2, 0}, {0, 2, 1}, {2, 1, 0}, {2, 2, 0}},
         {{3, 2, 1}, {4, 0, 4}, {1, 3, 3}},
         true},
        {"two hinged triangles", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}}, true},
        {"two hinged quads",
         {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}},
         {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {0, 4, 5}},
         true},
        {"a triangle and its back", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, {{0, 1, 2}, {0, 2, 1}}, true},
        {"triangles on one line",
         {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
         {{0, 1, 2}, {1, 2, 3}},
         false},
    };
    // Small tetrahedra far apart: hardly any volume, and what samples there are may lie in one plane.
    Case scattered{"scattered tetrahedra", {}, {}, true};
    for (const glm::dvec3& at :
         {glm::dvec3(0), {far, 0, 0}, {0, far, 0}, {far, far, 0}, {0, 0, far}, {far, 0, far}}) {
        const int first = int(scattered.positions.size());
        for (const glm::dvec3& corner : {glm::dvec3(0), {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}})
            scattered.positions.push_back(at + corner);
        for (const glm::ivec3& t : {glm::ivec3(0, 2, 1), {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
            scattered.triangles.push_back(t + first);
    }
    cases.push_back(scattered);
    for (const Case& one : cases) {
        Mesh mesh;
        mesh.positions = one.positions;
        mesh.triangles = one.triangles;
        completeMesh(mesh);
        for (const double size : {0.0, 0.2}) {
            INFO(one.name << ", " << size);
            FromMesh options;
            if (size > 0) options.size = size;
            const std::string message = messageOf([&] {
                const MadeMolecule out = made(mesh, options);
                CHECK(out.lowestFrequency > 1e-3);
                CHECK(out.lowestFrequency < 1e3);
                CHECK(out.skinError < 1e-6 * out.molecule.size());
                CHECK(analyse(out.molecule, false).totalMass > 0);
                parseMolecule(writeMolecule(out.molecule), "again.json");  // where NaN would be null
            });
            INFO(message);
            CHECK(message.empty() == one.made);
        }
    }
}

TEST_CASE("parts that face inwards and outwards weigh what they hold", "[from-mesh]") {
    Mesh mesh;
    addTube(mesh, "out", {0, 0, 0}, 0.1, 1, 12, 6);
    const size_t triangles = mesh.triangles.size();
    addTube(mesh, "in", {0.5, 0, 0}, 0.095, 1, 12, 6);
    for (size_t t = triangles; t < mesh.triangles.size(); ++t)
        std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
    completeMesh(mesh);
    const MadeMolecule out = made(mesh);
    CHECK(out.solid);
    CHECK(out.volume == Approx(3 * (0.1 * 0.1 + 0.095 * 0.095)).epsilon(0.1));  // prisms of twelve sides
}

TEST_CASE("no part of a long straight body is far from a simulated vertex", "[from-mesh]") {
    Mesh tube;
    addTube(tube, "a", {0, 0, 0}, 0.1, 2, 12, 20);
    completeMesh(tube);
    const MadeMolecule out = made(tube);
    double furthest = 0;
    for (const glm::dvec3& p : tube.weldedPositions) {
        double nearest = 1e9;
        for (const Vertex& vertex : out.molecule.vertices)
            nearest = std::min(nearest, glm::distance(vertex.position, p));
        furthest = std::max(furthest, nearest);
    }
    CHECK(furthest < 0.25 * glm::distance(tube.low, tube.high));
    CHECK(out.molecule.vertices.size() == 24);
    checkBraced(out.molecule);
}

TEST_CASE("pins by the bone that moves them", "[from-mesh]") {
    Mesh tube;
    addTube(tube, "a", {0, 0, 0}, 0.1, 2, 12, 20);
    completeMesh(tube);
    const glm::dvec3 extent = tube.high - tube.low;
    const int axis = extent.x > std::max(extent.y, extent.z) ? 0 : extent.y > extent.z ? 1 : 2;
    const double middle = 0.5 * (tube.low + tube.high)[axis];
    tube.boneNames = {"foot", "head"};
    for (const glm::dvec3& p : tube.positions)
        tube.bones.push_back(p[axis] < middle ? 0 : 1);
    FromMesh options;
    options.pins.names = {"foot"};
    const MadeMolecule out = made(tube, options);
    int pinned = 0;
    for (const Vertex& vertex : out.molecule.vertices) {
        CHECK(vertex.pinned == (vertex.position[axis] < middle));
        pinned += vertex.pinned;
    }
    CHECK(pinned >= 6);
    options.pins.names = {"hand"};
    CHECK_THAT(refused(tube, options), Catch::Contains("or bone \"hand\"; it has a, foot, head"));
}

TEST_CASE("a skin that would tear is refused", "[from-mesh]") {
    Mesh prism;  // the four vertices that are kept lie in one plane
    addTube(prism, "prism", {0, 0, 0}, 0.5, 0.6, 6, 1);
    completeMesh(prism);
    FromMesh options;
    options.vertices = 4;
    CHECK(
        refused(prism, options).starts_with("the skin would tear: with 4 simulated vertices it would hang "));
    options.vertices = 8;
    CHECK(refused(prism, options).empty());
    options.vertices = 4;
    options.skin = false;
    CHECK(refused(prism, options).empty());
}

TEST_CASE("a body with legs of its own parts is held by a cage, and no part moves further than it is moved",
          "[from-mesh][cage]") {
    Mesh mesh;
    addSphere(mesh, {0, 0, 0}, 0.3, 16, 9);
    for (int leg = 0; leg < 6; ++leg) {
        const double side = leg % 2 ? 1 : -1, along = 0.3 * (leg / 2 - 1);
        addBox(mesh, {side * 0.62 - 0.3, -0.03, along - 0.03}, {side * 0.62 + 0.3, 0.03, along + 0.03});
    }
    completeMesh(mesh);
    FromMesh options;
    options.springs = FromMesh::Springs::surface;
    CHECK(makeMolecule(mesh, options).skinLever > 2);
    options.springs = FromMesh::Springs::automatic;
    const MadeMolecule out = made(mesh, options);
    REQUIRE_FALSE(out.notes.empty());
    CHECK_THAT(out.notes.back(), Catch::Contains("times as far as one of them: a cage of cells"));
    CHECK(out.skinLever <= 1.2);
    CHECK(out.skinError < 1e-6 * out.molecule.size());
    CHECK(int(out.molecule.vertices.size()) <= cageVertices);
    CHECK(analyse(out.molecule, false).zeroModes == 0);
    CHECK(check(out.molecule).empty());
    for (const SkinVertex& vertex : out.molecule.skin.vertices) {
        double sum = 0;
        for (const SkinWeight& weight : vertex.weights)
            sum += weight.weight;
        CHECK(std::abs(sum - 1) < 1e-6);
        CHECK(vertex.weights.size() <= 4);
    }
    Mesh degenerate = mesh;
    degenerate.triangles.insert(degenerate.triangles.begin(), 5, glm::ivec3(7));  // which have no extent
    CHECK(writeMolecule(made(degenerate, options).molecule) == writeMolecule(out.molecule));
    // More vertices, finer cells; too few hold nothing.
    options.springs = FromMesh::Springs::cage;
    options.vertices = 120;
    const MadeMolecule fine = made(mesh, options);
    CHECK(fine.molecule.vertices.size() > 60);
    CHECK(fine.molecule.vertices.size() <= 120);
    CHECK(fine.skinLever <= 1.2);
    options.vertices = 5;
    CHECK(refused(mesh, options) ==
          "no cage of at most 5 vertices holds all parts of this mesh: take more vertices");
    // A sheet, which encloses nothing, has cells about it.
    Mesh sheet;
    sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    completeMesh(sheet);
    options.vertices = 40;
    const MadeMolecule flat = made(sheet, options);
    CHECK(flat.skinError < 1e-6);
    CHECK(analyse(flat.molecule, false).zeroModes == 0);
}

// Assimp's own models are not ours to ship: Debian has them in the package assimp-testmodels.
TEST_CASE("meshes that others made become molecules or are refused with a reason", "[from-mesh][models]") {
    const std::string folder = "/usr/share/assimp/models/";
    if (!std::filesystem::exists(folder)) {
        WARN("skipped: Assimp's models are not installed (on Debian: apt install assimp-testmodels)");
        return;
    }
    struct Model {
        const char* file;
        bool made;
    };
    int seen = 0;
    for (const Model& model :
         {Model{"OBJ/spider.obj", true}, Model{"OBJ/WusonOBJ.obj", true}, Model{"OBJ/box.obj", true},
          Model{"OBJ/concave_polygon.obj", true}, Model{"OBJ/cube_with_vertexcolors.obj", true},
          Model{"PLY/Wuson.ply", true}, Model{"STL/Spider_ascii.stl", true}, Model{"OFF/Wuson.off", true},
          Model{"3DS/fels.3ds", true}, Model{"Collada/duck.dae", true}, Model{"OBJ/point_cloud.obj", false},
          Model{"OBJ/testline.obj", false}, Model{"AMF/test9.amf", true}, Model{"X/anim_test.x", true},
          Model{"LWO/LWO2/box_2vc_1unused.lwo", true}}) {
        INFO(model.file);
        if (!std::filesystem::exists(folder + model.file)) continue;
        ++seen;
        const std::string message = messageOf([&] {
            FromMesh options;
            options.size = 0.2;
            const MadeMolecule out = made(loadMesh(folder + model.file), options);
            CHECK(int(out.molecule.vertices.size()) <= cageVertices);
            CHECK(out.skinLever <= 2);
            CHECK(analyse(out.molecule, false).zeroModes == 0);
            CHECK(out.skinError < 1e-5 * out.molecule.size());
            parseMolecule(writeMolecule(out.molecule), "again.json");
        });
        CHECK(message.empty() == model.made);
        if (!message.empty()) CHECK(message.find("has no triangles") != std::string::npos);
    }
    CHECK(seen >= 10);
}
