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

// Cubes of 10 cm with spheres of 3 cm, `gap` above one another along an axis, `aside` further at each.
Tower towerOf(int levels, double gap, double aside = 0, int axis = 1, double far = 0) {
    Scene scene;
    scene.gravity[axis] = -9.81;
    Group& group = scene.groups.emplace_back();
    group.name = "cubes";
    for (int i = 0; i < 8; ++i)
        group.molecule.vertices.push_back(
            {.position = 0.1 * (glm::dvec3(i & 1, i >> 1 & 1, i >> 2 & 1) - 0.5), .mass = 0.0125});
    for (int a = 0; a < 8; ++a)
        for (int b = a + 1; b < 8; ++b)
            group.molecule.springs.push_back({a, b, 1e5, 2, {}, {}});
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    for (int i = 0; i < levels; ++i) {
        Placement::Item& item = group.place.items.emplace_back();
        item.position = glm::dvec3(far);
        item.position[axis] += 0.08 + (0.16 + gap) * i;
        item.position[(axis + 1) % 3] += aside * i;
    }
    group.count = levels;
    group.contact.emplace().radius = 0.03;
    return compile(scene).contact.tower;
}

}  // namespace

TEST_CASE("the levels of a tower are counted, and only where molecules stand on one another", "[warnings]") {
    const int axis = GENERATE(0, 1, 2);
    const double far = GENERATE(0.0, 1e6);
    CAPTURE(axis, far);
    CHECK(towerOf(7, 0, 0, axis, far).levels == 7);
    CHECK(std::abs(towerOf(7, 0, 0, axis, far).height - 0.16) < 1e-3);
    CHECK(towerOf(7, 0.02, 0.03, axis, far).levels == 7);  // leans, and is let fall by 2 cm a level
    CHECK(towerOf(7, 0.04, 0, axis, far).levels == 0);     // further apart than a radius
    CHECK(towerOf(7, 0, 0.05, axis, far).levels == 0);     // beside one another
    CHECK(towerOf(1, 0, 0, axis, far).levels == 0);
}

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
