// "colorBy" of a group and "water" of a scene: what is read, what is refused and where.
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

std::string sceneWith(const std::string& groupKeys, const std::string& sceneKeys = "") {
    return R"({"format": "shoal-scene-1", "groups": [{"molecule": "blade.json", "place": {"on": "list", "items": [{}]})" +
           groupKeys + "}]" + sceneKeys + "}";
}

class Reader {
  public:
    Reader() { scratch_.write("blade.json", smallMolecule); }
    Scene operator()(const std::string& text) { return parseScene(text, scratch_.path("a.scene.json")); }
    std::string error(const std::string& groupKeys, const std::string& sceneKeys = "") {
        return messageOf([&] { (*this)(sceneWith(groupKeys, sceneKeys)); });
    }

  private:
    Scratch scratch_;
};

}  // namespace

TEST_CASE("a colour scale is read, with colours of its own or those of the default", "[scene]") {
    Reader read;
    const Scene plain = read(sceneWith(R"(, "colorBy": {"to": 60})"));
    const ColorScale& usual = plain.groups[0].colorBy.value();
    CHECK((usual.from == 0 && usual.to == 60 && usual.colors.size() == 8));
    // lighter step by step, as the eye weighs the parts
    for (size_t i = 0; i + 1 < usual.colors.size(); ++i) {
        const auto light = [](const glm::dvec3& c) {
            return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
        };
        CHECK(light(usual.colors[i + 1]) > light(usual.colors[i]));
    }
    const Scene own = read(sceneWith(
        R"(, "colorBy": {"quantity": "speed", "from": -1, "to": 2, "colors": [[0, 0, 1], [1, 0.5, 0]]})"));
    const ColorScale& scale = own.groups[0].colorBy.value();
    CHECK((scale.from == -1 && scale.to == 2));
    REQUIRE(scale.colors.size() == 2);
    CHECK(scale.colors[1] == glm::dvec3(1, 0.5, 0));
    CHECK(!read(sceneWith("")).groups[0].colorBy);
}

TEST_CASE("a colour scale without meaning is refused where it stands", "[scene]") {
    Reader read;
    CHECK_THAT(read.error(R"(, "colorBy": {})"), Contains("to"));
    CHECK_THAT(read.error(R"(, "colorBy": {"from": 3, "to": 3})"), Contains("above \"from\" (3)"));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "quantity": "mass"})"), Contains("speed"));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "colors": [[1, 1, 1]]})"),
               Contains("2 to 8 colours, found 1"));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "colors": [[1, 1, 1], [1, 2, 1]]})"),
               Contains("colorBy.colors[1]"));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "colors": [[1, 1, 1], 5]})"),
               Contains("colorBy.colors[1]"));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "colors": 5})"), Contains("array of colours"));
    CHECK_THAT(read.error(R"(, "color": [1, 0, 0], "colorBy": {"to": 1})"),
               Contains("no effect beside \"colorBy\""));
    CHECK_THAT(read.error(R"(, "colorBy": {"to": 1, "form": 2})"), Contains("from"));
}

TEST_CASE("water is read", "[scene]") {
    Reader read;
    CHECK(!read(sceneWith("")).water);
    const Water usual = read(sceneWith("", R"(, "water": {})")).water.value();
    CHECK((usual.surface == 0 && usual.caustics == 0.8 && usual.rays == 0.5));
    CHECK((usual.causticsSize == 1.2 && usual.causticsSpeed == 0.6));
    const Water own =
        read(sceneWith("", R"(, "water": {"surface": 3, "extinction": [1, 2, 3], "scattering": [0, 1, 2],
        "caustics": 0, "causticsSize": 4, "causticsSpeed": 5, "rays": 1})"))
            .water.value();
    CHECK(
        (own.surface == 3 && own.extinction == glm::dvec3(1, 2, 3) && own.scattering == glm::dvec3(0, 1, 2)));
    CHECK((own.caustics == 0 && own.causticsSize == 4 && own.causticsSpeed == 5 && own.rays == 1));
}

TEST_CASE("water that cannot be is refused where it stands", "[scene]") {
    Reader read;
    const auto error = [&](const std::string& water) {
        return read.error("", R"(, "water": {)" + water + "}");
    };
    CHECK_THAT(error(R"("extinction": [1, -1, 0])"), Contains("water.extinction"));
    CHECK_THAT(error(R"("extinction": 0.1)"), Contains("water.extinction"));
    CHECK_THAT(error(R"("scattering": [1, -1, 0])"), Contains("water.scattering"));
    CHECK_THAT(error(R"("caustics": 1.5)"), Contains("water.caustics"));
    CHECK_THAT(error(R"("causticsSize": 0)"), Contains("water.causticsSize"));
    CHECK_THAT(error(R"("causticsSpeed": -1)"), Contains("water.causticsSpeed"));
    CHECK_THAT(error(R"("rays": -1)"), Contains("water.rays"));
    CHECK_THAT(error(R"("surfice": 1)"), Contains("surface"));
}
