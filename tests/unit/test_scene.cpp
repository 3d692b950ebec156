#include <filesystem>
#include <numbers>

#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

template <typename Shape>
const Shape& shape(const Field& field) {
    return std::get<Shape>(*field.shape);
}

bool close(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b) < 1e-6;
}

}  // namespace

TEST_CASE("a scene keeps what its file says", "[scene]") {
    const Scratch scratch;
    const Scene scene = readScene(writeSmallScene(scratch));
    CHECK(scene.name == "all");
    CHECK(scene.seed == 18446744073709551615u);
    CHECK(scene.frameRate == 30);
    CHECK(scene.gravity == glm::dvec3(0, -9.81, 0));
    CHECK(scene.solver.kind == SolverKind::euler);
    CHECK(scene.solver.substeps == 12);
    CHECK(scene.solver.location.line == 7);
    CHECK(scene.camera.eye == glm::dvec3(1, 2, 3));
    CHECK(scene.camera.exposure == 2);
    CHECK(scene.light.direction == glm::dvec3(0, -1, 0));
    CHECK_FALSE(scene.light.shadows);
    CHECK(scene.sky.zenith == glm::dvec3(0, 0, 1));
    CHECK(scene.sky.fog == 0.1);
    CHECK(scene.warnings.empty());
}

TEST_CASE("a scene's fields", "[scene]") {
    const Scratch scratch;
    const Scene scene = readScene(writeSmallScene(scratch));
    REQUIRE(scene.fields.size() == 11);
    CHECK(scene.fields[0].name == "wind");
    CHECK(scene.fields[0].weight == 0.5);
    REQUIRE(scene.fields[0].box);
    CHECK(scene.fields[0].box->low == glm::dvec3(-1, -2, -3));
    CHECK(shape<UniformField>(scene.fields[0]).velocity == glm::dvec3(1, 2, 3));
    CHECK(shape<GustField>(scene.fields[1]).direction == glm::dvec3(0, 0, 1));
    CHECK(shape<GustField>(scene.fields[1]).frontSpeed == 4);
    CHECK(shape<GustField>(scene.fields[1]).seed == 5);
    // Rows in the file: the first is the gradient of u's x.
    const ShearField& shear = shape<ShearField>(scene.fields[2]);
    CHECK(shear.gradient * glm::dvec3(1, 0, 0) == glm::dvec3(1, 4, 7));
    CHECK(shape<VortexField>(scene.fields[3]).axis == glm::dvec3(0, 1, 0));
    CHECK(shape<VortexField>(scene.fields[3]).lift == 1);
    CHECK(shape<AbcField>(scene.fields[4]).c == 3);
    CHECK(shape<TaylorGreenField>(scene.fields[5]).wavelength == 3);
    CHECK(shape<CurlNoiseField>(scene.fields[6]).octaves == 4);
    const GridField& grid = shape<GridField>(scene.fields[7]);
    CHECK(grid.wrap);
    CHECK(grid.low == glm::dvec3(-2, -1, -2));
    CHECK(grid.values.at(1) == glm::vec3(3, -0.5f, 0));
    const OscillatingField& oscillating = shape<OscillatingField>(scene.fields[8]);
    CHECK(oscillating.velocity == glm::dvec3(0.5, 0, 2));
    CHECK(oscillating.frequency == 1.5);
    CHECK(oscillating.phase == -0.25);
    const WavesField& waves = shape<WavesField>(scene.fields[9]);
    CHECK(waves.origin.y == 2);
    CHECK(waves.depth == 3.0);
    CHECK(waves.gravity == 9);
    REQUIRE(waves.trains.size() == 1);
    CHECK(waves.trains[0].direction == glm::dvec3(1, 0, 1));
    CHECK(waves.trains[0].amplitude == 0.1);
    CHECK(waves.trains[0].wavelength == 4);
    CHECK(waves.trains[0].phase == 0.5);
    const HurricaneField& storm = shape<HurricaneField>(scene.fields[10]);
    CHECK(storm.origin.x == 1);
    CHECK(storm.speed == 9);
    CHECK(storm.radius == 4);
    CHECK(storm.shape == 1.2);
    CHECK(storm.inflow == 0.3);
    CHECK(storm.height == 5);
    CHECK(storm.coriolis == 0.001);
}

TEST_CASE("a scene's models and colliders", "[scene]") {
    const Scratch scratch;
    const Scene scene = readScene(writeSmallScene(scratch));
    REQUIRE(scene.models.size() == 1);
    const Mesh& mesh = scene.models[0].mesh;
    // Scaled by 2, turned so that +X becomes -Z, shifted by 1 along x.
    CHECK(close(mesh.low, {-7, 0, -8}));
    CHECK(close(mesh.high, {9, 6, 8}));
    CHECK(mesh.objects.size() == 2);

    REQUIRE(scene.colliders.size() == 3);
    CHECK(std::get<PlaneCollider>(*scene.colliders[0].shape).normal == glm::dvec3(0, 1, 0));
    CHECK(scene.colliders[0].restitution == 0.9);
    CHECK_FALSE(scene.colliders[0].draw);
    CHECK(std::get<SphereCollider>(*scene.colliders[1].shape).radius == 0.5);
    CHECK(scene.colliders[1].thickness == 0.01);
    const auto& heights = std::get<HeightFieldCollider>(*scene.colliders[2].shape);
    CHECK(heights.sampledNormals);
    CHECK(heights.columns == 5);
    // The slope rises along -X now: 2 m at the left edge, 0 at the right one.
    CHECK(heights.heights[0] == Approx(2));
    CHECK(heights.heights[4] == Approx(0).margin(1e-6));
}

TEST_CASE("a scene's groups", "[scene]") {
    const Scratch scratch;
    const Scene scene = readScene(writeSmallScene(scratch));
    REQUIRE(scene.groups.size() == 7);
    const Group& first = scene.groups[0];
    CHECK(first.name == "on it");
    CHECK(first.molecule.vertices.size() == 3);
    CHECK(first.location.path == "$.groups[0]");
    CHECK(first.place.align == Placement::Align::normal);
    CHECK(first.place.turn == Placement::Turn::yaw);
    CHECK(first.place.select.object == "post");
    CHECK(first.drag.directional());
    REQUIRE(first.release);
    CHECK(first.release->after == 2);
    CHECK(scene.groups[1].name == "blade");
    CHECK(scene.groups[1].drag.tangent == 2);
    CHECK_FALSE(scene.groups[1].drag.directional());
    CHECK_FALSE(scene.groups[1].held);
    CHECK_FALSE(scene.groups[1].collide);
    CHECK(scene.groups[2].secondColor == glm::dvec3(0, 1, 0));
    CHECK(scene.groups[3].count == 24);
    CHECK(scene.groups[3].place.scale == glm::dvec2(3));
    REQUIRE(scene.groups[4].count == 2);
    CHECK(scene.groups[4].place.turn == Placement::Turn::none);
    CHECK(scene.groups[4].place.items[0].rotation.z == Approx(std::sqrt(0.5)));
    for (size_t g = 0; g < scene.groups.size(); ++g)
        CHECK(place(scene, g).size() == size_t(scene.groups[g].count));
    // The only vertex of the post above 2.5 m is its tip, the model's scale included.
    for (const Instance& instance : place(scene, 0))
        CHECK(glm::distance(instance.position, {1, 6, 0}) < 0.11);
}

TEST_CASE("what a scene leaves out keeps its default", "[scene]") {
    const Scratch scratch;
    scratch.write("blade.json", smallMolecule);
    const Scene scene =
        parseScene(R"({"format": "shoal-scene-1", "groups": [{"molecule": "blade.json", "count": 2,
        "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}]})",
                   scratch.path("a.scene.json"));
    const Scene defaults;
    CHECK(scene.seed == defaults.seed);
    CHECK(scene.frameRate == defaults.frameRate);
    CHECK(scene.gravity == glm::dvec3(0));
    CHECK(scene.solver.kind == defaults.solver.kind);
    CHECK(scene.camera.eye == defaults.camera.eye);
    CHECK(scene.fields.empty());
    CHECK_FALSE(scene.groups[0].drag.any());
    CHECK_FALSE(scene.groups[0].release);
    CHECK(scene.groups[0].held);
}

TEST_CASE("a height field says where nothing lies beneath", "[scene]") {
    const Scratch scratch;
    scratch.write("hill.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nf 1 2 3\n");
    scratch.write("blade.json", smallMolecule);
    const Scene scene = parseScene(R"({"format": "shoal-scene-1", "models": [{"file": "hill.obj"}],
"colliders": [{"type": "heightField", "model": "hill", "resolution": 3}],
"groups": [{"molecule": "blade.json", "count": 1, "release": {"rate": 1},
            "place": {"on": "surface", "model": "hill"}}]})",
                                   scratch.path("a.scene.json"));
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].location.line == 2);
    CHECK_THAT(scene.warnings[0].message, Catch::Contains("3 of 9 height samples have no surface"));
}

TEST_CASE("the shipped scenes can be read and placed", "[scene]") {
    int scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SHOAL_SOURCE_DIR "/models")) {
        const std::string file = entry.path().string();
        if (!file.ends_with(".scene.json")) continue;
        ++scenes;
        const Scene scene = readScene(file);
        for (const Warning& warning : scene.warnings) {
            INFO(text(warning));
            // where boulders of the bird bath leave each other, the stone is as thin as you like
            CHECK_THAT(warning.message, Catch::Contains("thinner than two of its cells"));
        }
        for (size_t g = 0; g < scene.groups.size(); ++g)
            CHECK(place(scene, g).size() == size_t(scene.groups[g].count));
    }
    CHECK(scenes >= 2);
}
