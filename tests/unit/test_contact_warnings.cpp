// Warnings of contact that will not hold.
#include "compile/plan.h"
#include "molecule/molecule_file.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"

using namespace shoal;

namespace {

// Sweets that fall as a grid of so many layers onto a floor.
std::string warningsOfPile(int layers, int substeps, double drag = 0) {
    Scene scene;
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = substeps;
    Group& group = scene.groups.emplace_back();
    group.name = "sweets";
    group.molecule = readMolecule(SHOAL_SOURCE_DIR "/molecules/berry.json");
    group.place.kind = Placement::Kind::grid;
    group.place.origin = {0, 0.02, 0};
    group.place.spacing = glm::dvec3(0.031);
    group.place.cells = {6, layers, 6};
    group.count = 36 * layers;
    group.drag = {drag, drag};
    group.contact.emplace().radius = 0.008;
    scene.colliders.emplace_back().shape = PlaneCollider{};
    std::string out;
    for (const Warning& warning : compile(scene).warnings)
        out += warning.message + "\n";
    return out;
}

}  // namespace

// Of 160 layers the lowest end in one another with 4 contact steps, and with 12 hardly
// (docs/contact-figures.md).
TEST_CASE("a tall pile that falls too fast for its contact steps is warned of", "[warnings]") {
    CHECK_THAT(warningsOfPile(160, 4), Catch::Contains("reaches 9.9 m/s"));
    CHECK_THAT(warningsOfPile(160, 4), Catch::Contains("\"substeps\" of at least 12 instead of 4 hold it"));
    CHECK_THAT(warningsOfPile(160, 12), !Catch::Contains("spheres high"));
    CHECK_THAT(warningsOfPile(40, 4), !Catch::Contains("spheres high"));
    CHECK_THAT(warningsOfPile(160, 4, 9), !Catch::Contains("spheres high"));  // it falls at 1.1 m/s
}

TEST_CASE("molecules that spheres cannot close are refused", "[warnings]") {
    const auto scene = [](const char* molecule, const char* contact) {
        return parseScene(
            concat(R"({"format": "shoal-scene-1", "groups": [{"name": "a", "molecule": ")", SHOAL_SOURCE_DIR,
                   "/molecules/", molecule, R"(", "place": {"on": "list", "items": [{}]}, "contact": {)",
                   contact, "}}]}"),
            "s.json");
    };
    CHECK_THROWS_WITH(scene("point.json", R"("closed": true)"),
                      Catch::Contains("the molecule has no triangles (at $.groups[0].contact.closed)"));
    CHECK_THROWS_WITH(scene("leaf.json", R"("closed": true, "radius": 0.0009)"),
                      Catch::Contains("expected a radius of at least 0.000956"));
    CHECK_NOTHROW(scene("leaf.json", R"("closed": true, "radius": 0.001)"));
    CHECK_NOTHROW(scene("leaf.json", R"("closed": true)"));
}
