#include <algorithm>
#include <limits>

#include "geometry/mesh.h"
#include "scene/selection.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("a tube is as thick as its diameter", "[thickness]") {
    Mesh mesh;
    addTube(mesh, "tube", {3, 0, -2}, 0.25, 10, 48, 40);
    completeMesh(mesh);
    const std::vector<double> thickness = localThickness(mesh);
    size_t checked = 0;
    for (size_t v = 0; v < thickness.size(); ++v) {
        const double height = mesh.weldedPositions[v].y;
        if (height < 1 || height > 9) continue;  // near the caps normals lean outward
        // The middle ray meets the polygon between a flat and a corner: cos(pi / 48) at least. Rays beside
        // it are at most 3 % shorter.
        CHECK(thickness[v] <= 0.5 + 1e-9);
        CHECK(thickness[v] >= 0.5 * 0.95);
        ++checked;
    }
    CHECK(checked > 1000);
}

TEST_CASE("the faces of a slab are as thick as the slab", "[thickness]") {
    // A grid of 9 x 9 vertices above and below, 0.1 m apart; the rim is left open.
    Mesh mesh;
    for (int layer = 0; layer < 2; ++layer)
        for (int z = 0; z < 9; ++z)
            for (int x = 0; x < 9; ++x)
                mesh.positions.push_back({x, layer * 0.1, z});
    for (int z = 0; z < 8; ++z)
        for (int x = 0; x < 8; ++x) {
            const int low = z * 9 + x, high = low + 81;
            mesh.triangles.push_back({high, high + 9, high + 10});
            mesh.triangles.push_back({high, high + 10, high + 1});
            mesh.triangles.push_back({low, low + 10, low + 9});
            mesh.triangles.push_back({low, low + 1, low + 10});
        }
    completeMesh(mesh);
    for (const double t : localThickness(mesh))
        CHECK(t == Approx(0.1).epsilon(1e-9));
}

TEST_CASE("an open surface has no thickness", "[thickness]") {
    for (const double t : localThickness(square(2)))
        CHECK(t == std::numeric_limits<double>::infinity());
    CHECK(medianThickness(square(2)) == 0);
}

TEST_CASE("the median thickness is that of the larger part", "[thickness]") {
    Mesh mesh;
    addTube(mesh, "glass", {0, 0, 0}, 0.1, 4, 32, 80);
    addTube(mesh, "foot", {3, 0, 0}, 0.2, 0.5, 32, 20);  // a quarter of the surface
    completeMesh(mesh);
    CHECK(medianThickness(mesh) == Approx(0.2).epsilon(0.05));
}

TEST_CASE("thinnest picks the thinner of two tubes", "[thickness]") {
    Mesh mesh;
    addTube(mesh, "branch", {0, 0, 0}, 0.3, 4, 16, 20);
    addTube(mesh, "twig", {2, 0, 0}, 0.02, 4, 16, 20);
    completeMesh(mesh);

    Selection selection;
    selection.thinnest = 0.5;
    const Selected selected = select(mesh, selection);
    REQUIRE(selected.vertices.size() == mesh.weldedPositions.size() / 2);
    size_t onTwig = 0;
    for (const int v : selected.vertices)
        onTwig += mesh.weldedPositions[size_t(v)].x > 1 ? 1 : 0;
    CHECK(onTwig >= selected.vertices.size() - 2);  // a cap's middle sees along its tube

    Selection thin;
    thin.maxThickness = 0.1;
    for (const int v : select(mesh, thin).vertices)
        CHECK(mesh.weldedPositions[size_t(v)].x > 1);
}

TEST_CASE("a selection by object, colour and height says what each condition matched", "[thickness]") {
    Mesh mesh;
    addTube(mesh, "branch", {0, 0, 0}, 0.3, 4, 8, 4);
    addTube(mesh, "twig", {2, 0, 0}, 0.02, 4, 8, 4);
    mesh.colors.assign(mesh.positions.size(), glm::dvec3(1, 0, 0));
    for (size_t v = mesh.positions.size() / 2; v < mesh.positions.size(); ++v)
        mesh.colors[v] = {0, 1, 0};
    completeMesh(mesh);

    Selection selection;
    selection.object = "twig";
    selection.color = glm::dvec3(0.05, 0.95, 0);
    selection.minHeight = 3.5;
    const Selected top = select(mesh, selection);
    CHECK(top.vertices.size() == 9);   // one ring and the middle of the cap
    CHECK(top.triangles.size() == 8);  // the cap

    selection.color = glm::dvec3(1, 0, 0);
    const Selected none = select(mesh, selection);
    CHECK(none.vertices.empty());
    CHECK(none.report.find("of 84 vertices") != std::string::npos);
    CHECK(none.report.find("object \"twig\" matched 42") != std::string::npos);
    CHECK(none.report.find("minHeight 3.5 m matched 18") != std::string::npos);
}

// 60,000 triangles take a fraction of a second in a release build; a hang or a quadratic search would not
// end.
TEST_CASE("thickness of a large mesh", "[thickness]") {
    Mesh mesh;
    for (int i = 0; i < 100; ++i)
        addTube(mesh, "tube", {i % 10, 0, i / 10}, 0.02 + 0.002 * i, 3, 12, 24);
    completeMesh(mesh);
    REQUIRE(mesh.triangles.size() == 60000);
    const std::vector<double> thickness = localThickness(mesh);
    CHECK(std::count(thickness.begin(), thickness.end(), std::numeric_limits<double>::infinity()) == 0);
}
