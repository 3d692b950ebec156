// Particle types: read, refused, and written back.
#include "core/description.h"
#include "core/image.h"
#include "scene/json/scene_file.h"
#include "scene/scene.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// A scene file's text with one group of particles, and the images that it may name.
class Particles {
  public:
    Particles() {
        writePng(scratch_.path("puffs.png"), {40, 20, 4, std::vector<uint8_t>(40 * 20 * 4, 255)});
        scratch_.write("words.png", "not a picture");
        scratch_.write("point.json",
                       R"({"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0], "mass": 1}]})");
    }

    std::string file() const { return scratch_.path("s.json"); }
    Scene scene(const std::string& particle, const std::string& more = "") const {
        return parseScene(R"({"format": "shoal-scene-1", "groups": [{"count": 2,
"place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}},
)" + more + R"("particle": )" +
                              particle + "}]}",
                          file());
    }
    ParticleType type(const std::string& particle) const { return *scene(particle).groups.at(0).particle; }
    std::string error(const std::string& particle, const std::string& more = "") const {
        return messageOf([&] { scene(particle, more); });
    }

  private:
    Scratch scratch_;
};

// Everything that a quad can have.
const char* const flames = R"({
  "mass": 0.001, "size": [0.1, 0.3], "growth": [0.5, 2], "turn": [-1, 1], "spin": 3, "facing": "free",
  "colors": [{"color": [9, 3, 1]}, {"age": 0.1, "opacity": 0.5}, {"age": 0.75, "color": [0, 0, 0.5]}, {"age": 1, "opacity": 0}],
  "image": {"file": "puffs.png", "columns": 4, "rows": 2, "tiles": [1, 6], "flipBook": true, "frameRate": 12, "blend": false},
  "softness": 0.25, "lit": true, "sort": "spread", "spreadFrames": 7})";

}  // namespace

TEST_CASE("a group of particles keeps what its file says", "[particle]") {
    const Particles particles;
    const ParticleType type = particles.type(flames);
    CHECK(type.mass == 0.001);
    CHECK(type.shape == ParticleShape::quads);
    CHECK(type.facing == ParticleFacing::free);
    CHECK(type.size == glm::dvec2(0.1, 0.3));
    CHECK(type.growth == glm::dvec2(0.5, 2));
    CHECK(type.turn == glm::dvec2(-1, 1));
    CHECK(type.spin == glm::dvec2(3, 3));
    REQUIRE(type.colors.size() == 4);
    CHECK(type.colors[0].age == 0);
    CHECK(type.colors[0].color == glm::dvec3(9, 3, 1));
    CHECK(type.colors[0].opacity == 1);
    CHECK(type.colors[1].age == 0.1);
    CHECK(type.colors[1].color == glm::dvec3(1));
    CHECK(type.colors[3].opacity == 0);
    REQUIRE(type.image);
    CHECK_THAT(type.image->file, Contains("puffs.png"));
    CHECK(type.image->columns == 4);
    CHECK(type.image->rows == 2);
    CHECK(type.image->firstTile == 1);
    CHECK(type.image->lastTile == 6);
    CHECK(type.image->flipBook);
    CHECK(type.image->frameRate == 12);
    CHECK_FALSE(type.image->blend);
    CHECK(type.softness == 0.25);
    CHECK(type.lit);
    CHECK(type.blend == Blend::alpha);
    CHECK(type.sort == DrawSort::spread);
    CHECK(type.spreadFrames == 7);
}

TEST_CASE("a particle stands for a molecule of one vertex", "[particle]") {
    const Particles particles;
    const Scene scene = particles.scene(R"({"mass": 3, "blend": "additive"})");
    const Group& group = scene.groups[0];
    CHECK(group.name == "particle");
    REQUIRE(group.molecule.vertices.size() == 1);
    CHECK(group.molecule.vertices[0].mass == 3);
    CHECK(group.molecule.springs.empty());
    CHECK(group.molecule.material.blend == Blend::additive);
    CHECK(group.count == 2);
}

TEST_CASE("short forms of a particle's keys", "[particle]") {
    const Particles particles;
    CHECK(particles.type(R"({"growth": 3})").growth == glm::dvec2(1, 3));
    CHECK(particles.type(R"({"size": 2})").size == glm::dvec2(2, 2));
    const auto image = [&](const std::string& keys) {
        return *particles.type(R"({"image": {"file": "puffs.png", "columns": 4, "rows": 2)" + keys + "}}")
                    .image;
    };
    CHECK(image("").firstTile == 0);
    CHECK(image("").lastTile == 7);
    CHECK(image(R"(, "tile": 5)").firstTile == 5);
    CHECK(image(R"(, "tile": 5)").lastTile == 5);
}

TEST_CASE("particles: what is refused, and where", "[particle]") {
    const Particles particles;
    const auto refused = [&](const std::string& particle, const std::string& path, const std::string& why) {
        INFO(particle);
        CHECK_THAT(particles.error(particle),
                   Contains("s.json:3:") && Contains("$.groups[0].particle." + path + ")") && Contains(why));
    };
    refused(R"({"size": 0})", "size", "from 1e-09 to 1e+06");
    refused(R"({"size": -1})", "size", "from 1e-09 to 1e+06");
    refused(R"({"size": [2, 1]})", "size", "expected [least, most], found 2 above 1");
    refused(R"({"size": [1, 2, 3]})", "size", "2");
    refused(R"({"growth": -1})", "growth", "from 0 to 1e+06");
    refused(R"({"growth": [0, 0]})", "growth", "above 0 at birth or at the end");
    refused(R"({"mass": 0})", "mass", "from 1e-12");
    refused(R"({"spin": 1e7})", "spin", "to 1e+06");
    refused(R"({"colors": []})", "colors", "at least one keyframe");
    refused(R"({"colors": [{}, {"age": 0.1}, {"age": 0.2}, {"age": 0.3}, {"age": 0.4}]})", "colors",
            "at most 4 keyframes, found 5");
    refused(R"({"colors": [{"age": 0.5}, {"age": 0.25}]})", "colors[1].age",
            "above that of the keyframe before, 0.5");
    refused(R"({"colors": [{"age": 0.5}, {"age": 0.5}]})", "colors[1].age",
            "above that of the keyframe before");
    refused(R"({"colors": [{}, {}]})", "colors[1]", "missing key \"age\"");
    refused(R"({"colors": [{"age": 1.5}]})", "colors[0].age", "from 0 to 1");
    refused(R"({"colors": [{"color": [-1, 0, 0]}]})", "colors[0].color[0]", "from 0 to 1000");
    refused(R"({"colors": [{"opacity": 2}]})", "colors[0].opacity", "from 0 to 1");
    refused(R"({"softness": -1})", "softness", "from 0");
    refused(R"({"sizes": 1})", "sizes", "did you mean \"size\"");
}

TEST_CASE("particles: keys without effect are refused", "[particle]") {
    const Particles particles;
    const auto refused = [&](const std::string& particle, const std::string& key) {
        INFO(particle);
        CHECK_THAT(particles.error(particle),
                   Contains("\"" + key + "\"") && Contains("$.groups[0].particle." + key + ")"));
    };
    refused(R"({"shape": "points", "facing": "camera"})", "facing");
    refused(R"({"shape": "sprites", "facing": "free"})", "facing");
    refused(R"({"shape": "points", "size": 1})", "size");
    refused(R"({"shape": "points", "image": {"file": "puffs.png"}})", "image");
    refused(R"({"pixels": 3})", "pixels");
    refused(R"({"stretch": 1})", "stretch");
    refused(R"({"facing": "velocity", "spin": 1})", "spin");
    refused(R"({"blend": "additive", "sort": "frame"})", "sort");
    refused(R"({"spreadFrames": 3})", "spreadFrames");
    refused(R"({"blend": "none", "softness": 1})", "softness");
    refused(R"({"blend": "multiplicative", "lit": true})", "lit");
    CHECK_THAT(particles.error("{}", R"("color": [1, 1, 1], )"), Contains("$.groups[0].color"));
    CHECK_THAT(particles.error("{}", R"("molecule": "point.json", )"), Contains("$.groups[0].molecule"));
    CHECK_THAT(
        messageOf([&] { parseScene(R"({"format": "shoal-scene-1", "groups": [{}]})", particles.file()); }),
        Contains("give a \"molecule\" or a \"particle\"") && Contains("$.groups[0])"));
}

TEST_CASE("particles: bad images are refused", "[particle]") {
    const Particles particles;
    const auto refused = [&](const std::string& keys, const std::string& path, const std::string& why) {
        INFO(keys);
        CHECK_THAT(particles.error(R"({"image": {)" + keys + "}}"), Contains(why));
        CHECK_THAT(particles.error(R"({"image": {)" + keys + "}}"), Contains(path));
    };
    refused(R"("columns": 2)", "$.groups[0].particle.image)", "missing key \"file\"");
    refused(R"("file": "puff.png")", "image.file)", "no such file");
    refused(R"("file": "words.png")", "words.png", "expected a PNG picture");
    refused(R"("file": "puffs.png", "columns": 3)", "image.file)", "40 x 20 pixels, which 3 x 1 tiles");
    const std::string tiles = R"("file": "puffs.png", "columns": 4, "rows": 2, )";
    refused(tiles + R"("tile": 8)", "image.tile)", "tiles 0 to 7, found 8");
    refused(tiles + R"("tile": -1)", "image.tile)", "tiles 0 to 7, found -1");
    refused(tiles + R"("tiles": [0, 8])", "image.tiles)", "tiles 0 to 7, found 8");
    refused(tiles + R"("tiles": [3, 2])", "image.tiles)", "found 3 above 2");
    refused(tiles + R"("tiles": [3])", "image.tiles)", "found 1 number");
    refused(tiles + R"("tile": 1, "tiles": [0, 1])", "image.tiles)", "one of the two");
    refused(tiles + R"("tile": 1, "flipBook": true)", "image.flipBook)", "at least two tiles");
    refused(tiles + R"("frameRate": 10)", "image.frameRate)", "needs \"flipBook\": true");
    refused(tiles + R"("flipBook": true, "frameRate": -1)", "image.frameRate)", "from 0 to 1000");
    refused(R"("file": "puffs.png", "columns": 0)", "image.columns)", "from 1 to 64");
}

TEST_CASE("what changes with age is told where particles live for ever", "[particle]") {
    const Particles particles;
    const Scene scene = particles.scene(
        R"({"growth": 2, "colors": [{}, {"age": 1}], "image": {"file": "puffs.png", "columns": 2, "flipBook": true}})");
    REQUIRE(scene.warnings.size() == 3);
    CHECK_THAT(scene.warnings[0].message, Contains("only the first colour shows"));
    CHECK(scene.warnings[0].location.path == "$.groups[0].particle");
    CHECK(particles.scene("{}").warnings.empty());
}
