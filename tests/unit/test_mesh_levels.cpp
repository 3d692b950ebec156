#include "geometry/mesh_levels.h"

#include "support/catch.h"

using namespace shoal;

namespace {

struct Grid {
    std::vector<glm::dvec3> positions, normals;
    std::vector<uint32_t> corners;
};

// n x n squares of a sheet one metre wide, at the heights of `height`.
template <typename Height>
Grid sheet(int n, const Height& height) {
    Grid out;
    const double h = 1e-6;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = double(i) / n, z = double(j) / n;
            out.positions.emplace_back(x, height(x, z), z);
            const double slopeX = (height(x + h, z) - height(x, z)) / h;
            const double slopeZ = (height(x, z + h) - height(x, z)) / h;
            out.normals.push_back(glm::normalize(glm::dvec3(-slopeX, 1, -slopeZ)));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto a = uint32_t(j * (n + 1) + i), b = a + 1, c = a + uint32_t(n) + 1, d = c + 1;
            out.corners.insert(out.corners.end(), {a, c, b, b, c, d});
        }
    return out;
}

std::vector<MeshLevel> levelsOf(const Grid& grid) {
    return shoal::levelsOf(grid.positions, grid.normals, grid.corners);
}

double areaOf(const Grid& grid, const MeshLevel& level) {
    double out = 0;
    for (size_t i = 0; i < level.corners.size(); i += 3) {
        const glm::dvec3 a = grid.positions[level.corners[i]];
        out += 0.5 * glm::length(glm::cross(grid.positions[level.corners[i + 1]] - a,
                                            grid.positions[level.corners[i + 2]] - a));
    }
    return out;
}

}  // namespace

TEST_CASE("levels of a mesh have fewer triangles and larger errors", "[levels]") {
    const Grid grid = sheet(32, [](double x, double z) { return 0.2 * std::sin(3 * x) * std::cos(3 * z); });
    const std::vector<MeshLevel> levels = levelsOf(grid);
    REQUIRE(levels.size() >= 5);
    CHECK(levels[0].corners == grid.corners);
    CHECK(levels[0].error == 0);
    for (size_t i = 1; i < levels.size(); ++i) {
        CHECK(double(levels[i].corners.size()) <= 0.7 * double(levels[i - 1].corners.size()));
        CHECK(levels[i].error >= levels[i - 1].error);
        for (const uint32_t corner : levels[i].corners)
            REQUIRE(corner < grid.positions.size());
        CHECK(areaOf(grid, levels[i]) == Approx(areaOf(grid, levels[0])).epsilon(0.15));
    }
    CHECK(levels[1].error > 0);
    CHECK(levels.back().error < 0.3);
}

TEST_CASE("what is flat keeps vertices to bend by", "[levels]") {
    const std::vector<MeshLevel> levels = levelsOf(sheet(32, [](double, double) { return 0.0; }));
    REQUIRE(levels.size() >= 4);
    // An edge of length e on a bowl of radius r is e^2 / (8 r) off its middle, here r = 2 x 0.707 m.
    for (size_t i = 1; i < levels.size(); ++i) {
        const double edge = std::sqrt(2 / (double(levels[i].corners.size()) / 3));
        INFO("level " << i << ", error " << levels[i].error << ", edges of about " << edge);
        CHECK(levels[i].error > 0.2 * edge * edge / (8 * 1.414));
        CHECK(levels[i].error < 5 * edge * edge / (8 * 1.414));
    }
}

TEST_CASE("ripples that shade are not taken for flat", "[levels]") {
    // 2 mm high, and all that is seen of them is their slope
    const double ripple = 2e-3, waves = 8;
    const Grid rippled =
        sheet(64, [&](double x, double) { return ripple * std::sin(2 * 3.14159265 * waves * x); });
    const std::vector<MeshLevel> levels = levelsOf(rippled);
    size_t coarse = 0;
    while (coarse + 1 < levels.size() && levels[coarse].corners.size() > 3 * 100)
        ++coarse;
    REQUIRE(levels[coarse].corners.size() <= 3 * 100);  // too few for the ripples
    CHECK(levels[coarse].error > 2 * ripple);
}
