#include "core/error.h"
#include "scene/field_files/field_file.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

using namespace shoal;
using Catch::Contains;

namespace {

// Two by three by four cells; each cell's velocity is 100 x + 10 y + z of its index, in all parts.
std::string numbered() {
    std::string text = "2,3,4,\n0,0,0,\n2,6,12,\n";
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 2; ++x)
                text += concat(100 * x, ",", 10 * y + 1, ",", z + 2, ",\n");
    return text;
}

const glm::vec3& cell(const GridField& grid, int x, int y, int z) {
    return grid.values[size_t(x + grid.resolution.x * (y + grid.resolution.y * z))];
}

// In the scene's axes and units.
GridField read(const std::string& text, const GridSource& source = {}) {
    GridField grid;
    grid.source = source;
    addFrame(grid, parseFga(text, "field.fga"), "field.fga");
    return grid;
}

std::string message(const std::string& text, const GridSource& source = {}) {
    try {
        read(text, source);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("fga as it is", "[fga]") {
    const GridField grid = read(numbered());
    CHECK(grid.resolution == glm::ivec3(2, 3, 4));
    CHECK(grid.low == glm::dvec3(0));
    CHECK(grid.high == glm::dvec3(2, 6, 12));
    REQUIRE(grid.values.size() == 24);
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 2; ++x)
                CHECK(cell(grid, x, y, z) == glm::vec3(100 * x, 10 * y + 1, z + 2));
}

TEST_CASE("fga with z up, right-handed", "[fga]") {
    const GridField grid = read(numbered(), {.axes = FieldAxes::zUp});
    CHECK(grid.resolution == glm::ivec3(2, 4, 3));
    CHECK(grid.low == glm::dvec3(0, 0, -6));
    CHECK(grid.high == glm::dvec3(2, 12, 0));
    // The file's cell (1, 0, 3) is the scene's (1, 3, 2): low y is high z.
    CHECK(cell(grid, 1, 3, 2) == glm::vec3(100, 5, -1));
    CHECK(cell(grid, 0, 0, 0) == glm::vec3(0, 2, -21));
}

TEST_CASE("fga from Unreal, left-handed with z up, in centimetres", "[fga]") {
    const GridSource source{.axes = FieldAxes::unreal, .scale = 0.01, .origin = {1, 2, 3}};
    const GridField grid = read(numbered(), source);
    CHECK(grid.resolution == glm::ivec3(2, 4, 3));
    CHECK(grid.low == glm::dvec3(1, 2, 3));
    CHECK(glm::distance(grid.high, glm::dvec3(1.02, 2.12, 3.06)) < 1e-12);
    CHECK(glm::distance(cell(grid, 1, 3, 2), glm::vec3(1, 0.05f, 0.21f)) < 1e-6f);
}

TEST_CASE("fga velocities may have a scale of their own", "[fga]") {
    const GridField grid = read(numbered(), {.scale = 0.01, .velocityScale = 2.0});
    CHECK(grid.high.x == Approx(0.02));
    CHECK(cell(grid, 1, 0, 0) == glm::vec3(200, 2, 4));
}

TEST_CASE("fga separators: commas, white space, or both", "[fga]") {
    const char* text = "\xEF\xBB\xBF 1 1 1\r\n -1, -1 ,-1 1 1\t1\n+0.5 -2.5e-1,1";
    CHECK(read(text).values.at(0) == glm::vec3(0.5f, -0.25f, 1));
}

TEST_CASE("fga mistakes name line and column", "[fga]") {
    CHECK_THAT(message(""),
               Contains("field.fga:1:1: expected the resolution along x, found the end of the file"));
    CHECK_THAT(message("1,1,1,\n0,0,0,\n1,one,1\n0,0,0"),
               Contains("field.fga:3:3: expected a number, found \"one\""));
    CHECK_THAT(message("1,1,1,\n0,0,0,,"), Contains("field.fga:2:7: expected a number, found \",\""));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,nan,0,0"),
               Contains(":1:19: expected a finite number, found \"nan\""));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,0,0,-inf"), Contains("expected a finite number, found \"-inf\""));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,0,0,1e999"), Contains("range of doubles, found \"1e999\""));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,0,0,1e308"), Contains("beyond single precision"));
    CHECK_THAT(message("1,0,1,"),
               Contains(":1:3: expected the resolution along y as a whole number of at least 1, found 0"));
    CHECK_THAT(message("1,1,-4"), Contains("resolution along z as a whole number of at least 1, found -4"));
    CHECK_THAT(message("2.5,1,1"), Contains("found 2.5"));
    CHECK_THAT(message("4096,4096,2"), Contains(":1:11: the resolution makes more than 16777216 cells"));
    CHECK_THAT(message("1e300,1,1"), Contains("more than 16777216 cells"));
    CHECK_THAT(message("1,1,1,0,0,0,1,0,1"),
               Contains(":1:15: expected the high bound along y above the low one (0), found 0"));
    CHECK_THAT(message("2,2,2,0,0,0,1,1,1,\n1,2,3"), Contains("field.fga:2:6: expected 24 values, found 3"));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,\n1,2,3,\n4,5"),
               Contains("field.fga:3:1: expected 3 values, found 5"));
    CHECK_THAT(message("1,1,1,0,0,0,1,1,1,0,0,0", {.scale = 1e40}), Contains("beyond single precision"));
}
