#include <cmath>

#include "core/image.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("a tilted plane rasterises to its own heights", "[heightField]") {
    Mesh mesh = square(8);
    for (glm::dvec3& p : mesh.positions)
        p.y = 0.5 * p.x - 0.25 * p.z + 3;
    completeMesh(mesh);
    int missed = -1;
    const HeightFieldCollider field = heightFieldFromMesh(mesh, 17, 9, &missed);
    CHECK(missed == 0);
    REQUIRE(field.heights.size() == 17 * 9);
    CHECK(field.low == glm::dvec2(-4, -4));
    CHECK(field.high == glm::dvec2(4, 4));
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 17; ++column) {
            const double x = -4 + 0.5 * column, z = -4 + row;
            CHECK(field.heights[size_t(row * 17 + column)] == Approx(0.5 * x - 0.25 * z + 3).margin(1e-6));
        }
}

TEST_CASE("heights far up are as exact as at the origin", "[heightField]") {
    for (const double up : {0.0, 1e3, 1e4, 1e5, 1e6, -1e6}) {
        Mesh mesh = square(8);
        for (glm::dvec3& p : mesh.positions)
            p.y = 0.5 * p.x - 0.25 * p.z + up + 0.3;
        completeMesh(mesh);
        const HeightFieldCollider field = heightFieldFromMesh(mesh, 17, 9);
        const HeightFieldCollider painted =
            heightFieldFromImage({2, 2, {0, 1, 0.5f, 0.25f}}, {-1, -2}, {1, 2}, {up + 0.3, up + 0.7});
        CAPTURE(up);
        CHECK(std::abs(field.level + double(field.heights[40]) - (up + 0.3 - 0.5 + 0.5)) < 1e-4);
        CHECK(std::abs(painted.level + double(painted.heights[1]) - (up + 0.7)) < 1e-4);
    }
}

TEST_CASE("the highest of several surfaces counts", "[heightField]") {
    Mesh mesh;
    addTube(mesh, "tube", {0, 1, 0}, 1, 2, 64, 3);
    completeMesh(mesh);
    int missed = 0;
    const HeightFieldCollider field = heightFieldFromMesh(mesh, 33, 33, &missed);
    CHECK(field.heights[16 * 33 + 16] == Approx(3));  // the upper cap, not the lower one
    CHECK(field.heights[0] == Approx(1));             // beside the tube: the lowest height
    // The samples outside the circle miss: about a share of 1 - pi / 4.
    CHECK(missed / (33.0 * 33.0) == Approx(1 - 3.14159 / 4).margin(0.06));
}

TEST_CASE("grey levels become heights, north up", "[heightField]") {
    const HeightImage image{2, 2, {0, 1, 0.5f, 0.25f}};
    const HeightFieldCollider field = heightFieldFromImage(image, {-1, -2}, {1, 2}, {10, 20});
    CHECK(field.columns == 2);
    CHECK(field.rows == 2);
    CHECK(field.heights == std::vector<float>{10, 20, 15, 12.5f});
}
