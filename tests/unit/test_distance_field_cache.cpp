// Fields that are kept, and those that a scene asks for.
#include <algorithm>
#include <cstring>

#include "geometry/distance_field.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/small_scene.h"
#include "support/solids.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Mesh torus() {
    Mesh mesh;
    addTorus(mesh, {0, 0, 0}, 1, 0.35, 24, 12);
    completeMesh(mesh);
    return mesh;
}

FieldRequest small() {
    FieldRequest out;
    out.resolution = 12;
    out.thickness = 0.01;
    return out;
}

bool sameBits(const DistanceField& a, const DistanceField& b) {
    return a.distances.size() == b.distances.size() &&
           std::memcmp(a.distances.data(), b.distances.data(), a.distances.size() * sizeof(float)) == 0 &&
           a.grid.low == b.grid.low && a.grid.cell == b.grid.cell && a.outside == b.outside &&
           a.error.most == b.error.most && a.resolution == b.resolution && a.thinnest == b.thinnest;
}

std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        out.push_back(entry.path());
    return out;
}

const char* const crate =
    "o crate\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

// A scene with one distance field of the keys given.
std::string sceneWith(const std::string& keys) {
    return R"({"format": "shoal-scene-1", "models": [{"name": "crate", "file": "crate.obj"}],
 "colliders": [{"type": "distanceField", )" +
           keys + R"(}], "groups": [{"molecule": "blade.json", "count": 1, "place": {"on": "volume",
 "box": {"low": [0, 2, 0], "high": [1, 3, 1]}}}]})";
}

Scene readWith(const Scratch& scratch, const std::string& keys, const std::string& model = crate) {
    scratch.write("crate.obj", model);
    scratch.write("blade.json", smallMolecule);
    return readScene(scratch.write("field.scene.json", sceneWith(keys)), {{scratch.path("cache"), {}}});
}

}  // namespace

TEST_CASE("a field is kept by its mesh, wherever that stands", "[distanceField]") {
    const Scratch scratch;
    const FieldBaking baking{scratch.path("cache"), {}};
    std::vector<Warning> warnings;
    const DistanceField here = distanceFieldOf(torus(), small(), baking, warnings);
    const glm::dvec3 by(12.3, -0.7, 100.1);
    const auto movedTorus = [&](double size) {
        Mesh out = torus();
        for (glm::dvec3& place : out.positions)
            place = size * place + by;
        completeMesh(out);
        return out;
    };
    const DistanceField there = distanceFieldOf(movedTorus(1), small(), baking, warnings);
    CHECK(there.cached);
    CHECK(there.distances == here.distances);
    CHECK(glm::distance(there.grid.low, here.grid.low + by) < 1e-7);
    CHECK(glm::distance(there.error.where, here.error.where + by) < 1e-7);
    for (const glm::dvec3& x : {glm::dvec3(1.1, 0.2, 0.3), glm::dvec3(3, 0, 0)})
        CHECK(valueAt(there, x + by).distance == Approx(valueAt(here, x).distance).margin(1e-7));
    // and by nothing that happens to look alike
    CHECK_FALSE(distanceFieldOf(movedTorus(1.001), small(), baking, warnings).cached);
    CHECK(warnings.empty());
}

TEST_CASE("a scene bakes when all else of it is right", "[distanceField]") {
    const Scratch scratch;
    scratch.write("crate.obj", crate);
    scratch.write("blade.json", smallMolecule);
    std::string text = sceneWith(R"("model": "crate", "resolution": 8)");
    text.insert(text.rfind("\"count\""), "\"drag\": -1, ");
    const std::string file = scratch.write("wrong.scene.json", text);
    const std::string refusal = messageOf([&] { readScene(file, {{scratch.path("cache"), {}}}); });
    CHECK(refusal.find("$.groups[0].drag") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(scratch / "cache"));
}

TEST_CASE("a model stands on the ground", "[distanceField]") {
    const Scratch scratch;
    std::string text = sceneWith(R"("model": "crate", "resolution": 8)");
    scratch.write("crate.obj", crate);
    scratch.write("blade.json", smallMolecule);
    text.insert(text.find("\"file\""),
                R"("stand": true, "position": [5, 0, 1], "rotation": {"axis": [1, 0, 1], "angle": 0.7}, )");
    const Scene scene = readScene(scratch.write("s.scene.json", text), {{{}, {}}});
    const Mesh& mesh = scene.models[0].mesh;
    CHECK(mesh.low.y == Approx(0).margin(1e-12));
    CHECK(mesh.high.y > 1);
    double lowest = 1e9;
    for (const glm::dvec3& place : mesh.weldedPositions)
        lowest = std::min(lowest, place.y);
    CHECK(lowest == Approx(0).margin(1e-12));
}

TEST_CASE("a kept field has the same bits", "[distanceField]") {
    const Scratch scratch;
    const FieldBaking baking{scratch.path("cache"), {}};
    std::vector<Warning> warnings;
    const DistanceField baked = distanceFieldOf(torus(), small(), baking, warnings);
    CHECK_FALSE(baked.cached);
    REQUIRE(filesIn(scratch / "cache").size() == 1);
    const DistanceField kept = distanceFieldOf(torus(), small(), baking, warnings);
    CHECK(kept.cached);
    CHECK(sameBits(baked, kept));
    CHECK(kept.surface.closed());
    CHECK(warnings.empty());
    // baked again
    CHECK(sameBits(baked, distanceFieldOf(torus(), small(), {}, warnings)));

    // another request or mesh is another field
    FieldRequest finer = small();
    finer.resolution = 13;
    CHECK_FALSE(distanceFieldOf(torus(), finer, baking, warnings).cached);
    finer = small();
    finer.thickness = 0.02;
    CHECK_FALSE(distanceFieldOf(torus(), finer, baking, warnings).cached);
    Mesh moved = torus();
    moved.positions[5].x += 1e-6;
    completeMesh(moved);
    CHECK_FALSE(distanceFieldOf(moved, small(), baking, warnings).cached);
    CHECK(filesIn(scratch / "cache").size() == 4);

    // without a folder nothing is kept
    CHECK_FALSE(distanceFieldOf(torus(), small(), {}, warnings).cached);
    CHECK(warnings.empty());
}

TEST_CASE("a damaged, cut or foreign kept field is baked anew", "[distanceField]") {
    const Scratch scratch;
    const FieldBaking baking{scratch.path("cache"), {}};
    std::vector<Warning> warnings;
    const DistanceField baked = distanceFieldOf(torus(), small(), baking, warnings);
    const std::filesystem::path file = filesIn(scratch / "cache").at(0);
    const std::string whole = readFile(file);
    std::vector<std::string> broken{whole.substr(0, whole.size() - 4), whole.substr(0, 100), "", whole + "x"};
    for (size_t at : {size_t(0), size_t(9), size_t(20), size_t(60), size_t(180), whole.size() / 2}) {
        broken.push_back(whole);
        broken.back()[at] = char(broken.back()[at] ^ 0x40);
    }
    for (const std::string& bytes : broken) {
        writeFile(file, bytes);
        warnings.clear();
        const DistanceField again = distanceFieldOf(torus(), small(), baking, warnings);
        CHECK_FALSE(again.cached);
        CHECK(sameBits(baked, again));
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].message.find("damaged; baked anew") != std::string::npos);
        CHECK(readFile(file).size() == whole.size());
    }
    // another field's file under this name
    FieldRequest other = small();
    other.resolution = 13;
    distanceFieldOf(torus(), other, baking, warnings);
    for (const std::filesystem::path& one : filesIn(scratch / "cache"))
        if (one != file)
            std::filesystem::copy_file(one, file, std::filesystem::copy_options::overwrite_existing);
    CHECK_FALSE(distanceFieldOf(torus(), small(), baking, warnings).cached);

    // where nothing can be written the field is there all the same
    warnings.clear();
    CHECK(sameBits(baked, distanceFieldOf(torus(), small(), {scratch.write("file", "x"), {}}, warnings)));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].message.find("baked at every start") != std::string::npos);
}

TEST_CASE("a scene's distance field", "[distanceField][scene]") {
    const Scratch scratch;
    const Scene scene =
        readWith(scratch, R"("model": "crate", "resolution": 8, "thickness": 0.1, "friction": 1)");
    REQUIRE(scene.colliders.size() == 1);
    const auto& collider = std::get<DistanceFieldCollider>(*scene.colliders[0].shape);
    CHECK(collider.model == "crate");
    CHECK(collider.field.resolution == 8);
    CHECK(collider.field.grid.cell == 0.125);
    CHECK(collider.field.outside >= 0.1);
    CHECK(scene.colliders[0].friction == 1);
    CHECK(scene.warnings.empty());
    // the default
    CHECK(std::get<DistanceFieldCollider>(*readWith(scratch, R"("model": "crate")").colliders[0].shape)
              .field.resolution == defaultResolution);

    // open: half of a face is missing
    std::string open = crate;
    open.resize(open.rfind("f 4"));
    const Scene shell = readWith(scratch, R"("model": "crate", "resolution": 10, "shell": 0.3)", open);
    REQUIRE(shell.warnings.size() == 1);
    const std::string warning = text(shell.warnings[0]);
    CHECK(warning.find("$.colliders[0].model") != std::string::npos);
    CHECK(warning.find("model \"crate\" is not closed (4 border edges, the first at (") != std::string::npos);
    CHECK(warning.find("of \"crate\"") != std::string::npos);
    CHECK(std::get<DistanceFieldCollider>(*shell.colliders[0].shape).field.shell == 0.3);
}

TEST_CASE("mistakes in a distance field are located", "[distanceField][scene]") {
    const Scratch scratch;
    const auto message = [&](const std::string& keys, const std::string& model = crate) {
        return messageOf([&] { readWith(scratch, keys, model); });
    };
    const auto tells = [](const std::string& all, const std::string& part) {
        INFO(all);
        CHECK(all.find(part) != std::string::npos);
    };
    tells(message(R"("resolution": 8)"), "model");
    tells(message(R"("model": "crat")"), "did you mean \"crate\"");
    tells(message(R"("model": "crate", "resolution": 8, "error": 0.1)"),
          "expected either \"resolution\" or \"error\", found both (at $.colliders[0].error)");
    tells(message(R"("model": "crate", "resolution": 2)"), "$.colliders[0].resolution");
    tells(message(R"("model": "crate", "resolution": 100000)"), "$.colliders[0].resolution");
    tells(message(R"("model": "crate", "resolution": 600)"),
          "at most resolution 248 fits (at $.colliders[0].resolution)");
    tells(message(R"("model": "crate", "error": 0)"), "$.colliders[0].error");
    tells(message(R"("model": "crate", "error": -1)"), "$.colliders[0].error");
    tells(message(R"("model": "crate", "shell": 0)"), "$.colliders[0].shell");
    tells(message(R"("model": "crate", "shel": 1)"), "did you mean \"shell\"");
    tells(message(R"("model": "crate")", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
          "model \"crate\": has no surface: none of its triangles has an area (at $.colliders[0].model)");
}
