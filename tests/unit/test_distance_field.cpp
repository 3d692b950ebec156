// Fields against closed forms and brute force.
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "geometry/closest_point.h"
#include "geometry/distance_field.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/solids.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Evenly spread over a box a little larger than the mesh: Weyl's sequence.
std::vector<glm::dvec3> pointsAround(const Mesh& mesh, int count, double beyond = 0.1) {
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double more = beyond * std::max({extent.x, extent.y, extent.z});
    std::vector<glm::dvec3> out;
    for (int i = 1; i <= count; ++i)
        out.push_back(mesh.low - more +
                      (extent + 2 * more) *
                          glm::fract(double(i) * glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779)));
    return out;
}

FieldRequest resolution(int cells) {
    FieldRequest out;
    out.resolution = cells;
    return out;
}

// Returns the largest difference of the field's samples from `exact`, in cells.
template <typename Exact>
double worstSample(const DistanceField& field, Exact&& exact) {
    double worst = 0;
    for (int z = 0; z < field.grid.size.z; z += 3)
        for (int y = 0; y < field.grid.size.y; y += 2)
            for (int x = 0; x < field.grid.size.x; x += 3)
                worst = std::max(worst, std::abs(double(field.distances[field.grid.index(x, y, z)]) -
                                                 exact(field.grid.place(x, y, z))));
    return worst / field.grid.cell;
}

// How many points off the surface have the wrong sign: against solid angles.
int wrongSigns(const DistanceField& field, const Mesh& mesh, int count) {
    int wrong = 0;
    for (const glm::dvec3& x : pointsAround(mesh, count)) {
        if (bruteDistance(mesh, x) < 1.8 * field.grid.cell) continue;  // thin air between samples
        const bool inside = std::abs(solidAngles(mesh, x)) > 0.5;
        wrong += (valueAt(field, x).distance < 0) != inside;
    }
    return wrong;
}

Mesh turnedAndMoved(Mesh mesh, const glm::dvec3& by, double scale = 1) {
    const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    for (glm::dvec3& p : mesh.positions)
        p = turn * p * scale + by;
    mesh.normals.clear();
    completeMesh(mesh);
    return mesh;
}

}  // namespace

TEST_CASE("closest points are exact, however the mesh lies", "[distanceField]") {
    for (const auto& [scale, by] :
         {std::pair(1.0, glm::dvec3(0)), std::pair(1e-6, glm::dvec3(1e-3, 0, 0)),
          std::pair(1e7, glm::dvec3(0)), std::pair(1.0, glm::dvec3(1e5, -3e4, 2e5))}) {
        Mesh mesh;
        addTorus(mesh, {0, 0, 0}, 1, 0.3, 24, 12);
        addBox(mesh, {-0.2, -0.2, -0.2}, {0.2, 0.1, 0.2});
        mesh = turnedAndMoved(std::move(mesh), by, scale);
        const ClosestPoints closest(mesh);
        double worst = 0;
        for (const glm::dvec3& x : pointsAround(mesh, 400)) {
            const ClosestPoint found = closest.find(x);
            worst = std::max(worst, std::abs(found.distance - bruteDistance(mesh, x)));
            CHECK(glm::distance(found.point, x) == Approx(found.distance).epsilon(1e-6).margin(1e-9 * scale));
            // a bound that holds changes nothing
            CHECK(closest.find(x, found.distance * 1.01 + 1e-9 * scale).distance == found.distance);
            CHECK(closest.find(x, found.distance * 0.9).triangle ==
                  (found.distance > 1e-5 * scale ? -1 : found.triangle));
        }
        INFO("scale " << scale);
        CHECK(worst < std::max(1e-12 * scale, 1e-10 * glm::length(by)));
    }
}

TEST_CASE("a box's samples are its distances", "[distanceField]") {
    const glm::dvec3 low(-0.5, -0.3, -0.41), high(0.5, 0.33, 0.2);
    const DistanceField field = bakeDistanceField(boxMesh(low, high), resolution(32));
    CHECK(field.surface.closed());
    CHECK(field.shell == 0);
    CHECK(field.thinArea == 0);
    CHECK(worstSample(field, [&](const glm::dvec3& x) { return boxDistance(low, high, x); }) < 1e-5);
    // the grid holds the model and a margin
    for (int i = 0; i < 3; ++i) {
        CHECK(field.grid.low[i] <= low[i] - 2 * field.grid.cell);
        CHECK(field.grid.high()[i] >= high[i] + 2 * field.grid.cell);
    }
}

TEST_CASE("a sphere's samples are those of its polyhedron, and the sphere's to its sagitta",
          "[distanceField]") {
    Mesh mesh;
    addSphere(mesh, {1, 2, 3}, 0.5, 48, 24);
    completeMesh(mesh);
    const DistanceField field = bakeDistanceField(mesh, resolution(24));
    CHECK(worstSample(field, [&](const glm::dvec3& x) {
              const double d = bruteDistance(mesh, x);
              return std::abs(solidAngles(mesh, x)) > 0.5 ? -d : d;
          }) < 1e-4);
    CHECK(worstSample(field,
                      [&](const glm::dvec3& x) {
                          return glm::distance(x, {1, 2, 3}) - 0.5;
                      }) *
              field.grid.cell <
          0.5 * (1 - std::cos(std::numbers::pi / 24)) * 1.5);
}

TEST_CASE("a torus' samples and its error, which falls with the square of the cell", "[distanceField]") {
    Mesh mesh;
    addTorus(mesh, {0, 0, 0}, 1, 0.35, 256, 96);
    completeMesh(mesh);
    const auto exact = [](const glm::dvec3& x) {
        return glm::length(glm::dvec2(glm::length(glm::dvec2(x.x, x.z)) - 1, x.y)) - 0.35;
    };
    const DistanceField coarse = bakeDistanceField(mesh, resolution(20)),
                        fine = bakeDistanceField(mesh, resolution(40));
    CHECK(worstSample(coarse, exact) * coarse.grid.cell < 3e-4);  // the sagitta of the tube's sides is 1.9e-4
    CHECK(coarse.error.probes > 500);
    CHECK(coarse.error.most > 2.5 * fine.error.most);
    CHECK(coarse.error.rms > 3 * fine.error.rms);
    CHECK(coarse.error.most < 0.3 * coarse.grid.cell);
    CHECK(coarse.error.rms <= coarse.error.most);
}

TEST_CASE("between samples the value is trilinear and the gradient is its own", "[distanceField]") {
    Mesh mesh;
    addTorus(mesh, {0, 0, 0}, 1, 0.35, 24, 12);
    completeMesh(mesh);
    const DistanceField field = bakeDistanceField(mesh, resolution(16));
    for (const glm::dvec3& x : pointsAround(mesh, 200, 0.05)) {
        const FieldValue value = valueAt(field, x);
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 step(0);
            step[i] = 1e-7;
            const double slope =
                (valueAt(field, x + step).distance - valueAt(field, x - step).distance) / 2e-7;
            CHECK(value.gradient[i] == Approx(slope).margin(2e-5));
        }
    }
    const SampleGrid& grid = field.grid;
    CHECK(valueAt(field, grid.place(3, 4, 5)).distance ==
          Approx(field.distances[grid.index(3, 4, 5)]).margin(1e-12));
}

TEST_CASE("beyond the grid the distance is a lower bound and grows with the way", "[distanceField]") {
    Mesh mesh;
    addTorus(mesh, {0, 0, 0}, 1, 0.35, 24, 12);
    completeMesh(mesh);
    const DistanceField field = bakeDistanceField(mesh, resolution(16));
    CHECK(field.outside > 0);
    for (const glm::dvec3& x : pointsAround(mesh, 300, 2)) {
        const glm::dvec3 nearest = glm::clamp(x, field.grid.low, field.grid.high());
        if (nearest == x) continue;
        const FieldValue value = valueAt(field, x);
        CHECK(value.distance <= bruteDistance(mesh, x));
        CHECK(value.distance == Approx(glm::distance(x, nearest) + field.outside));
        CHECK(glm::length(value.gradient - glm::normalize(x - nearest)) < 1e-12);
    }
}

TEST_CASE("signs are right for shells of every kind", "[distanceField]") {
    const auto check = [](const char* what, Mesh mesh) {
        INFO(what);
        mesh = turnedAndMoved(std::move(mesh), {0.3, 0.1, -0.2});
        const DistanceField field = bakeDistanceField(mesh, resolution(32));
        CHECK(field.surface.closed());
        CHECK(wrongSigns(field, mesh, 600) == 0);
    };
    Mesh overlap, touching, nested, inverted, cavity, mixed;
    addBox(overlap, {0, 0, 0}, {0.6, 0.6, 0.6});
    addBox(overlap, {0.3, 0.3, 0.3}, {1, 1, 1});
    addSphere(overlap, {0.9, 0.3, 0.3}, 0.35, 16, 8);
    check("overlapping", overlap);
    addBox(touching, {0, 0, 0}, {0.5, 1, 1});
    addBox(touching, {0.5, 0, 0}, {1, 0.5, 1});
    check("touching along a face", touching);
    addBox(nested, {0, 0, 0}, {1, 1, 1});
    addBox(nested, {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7});
    check("one inside another", nested);
    addTorus(inverted, {0, 0, 0}, 1, 0.3, 24, 12);
    for (glm::ivec3& t : inverted.triangles)
        std::swap(t.y, t.z);
    check("inside out", inverted);
    cavity = inverted;
    addBox(cavity, {-2, -1, -2}, {2, 1, 2});
    check("a cavity", cavity);
    addBox(mixed, {0, 0, 0}, {0.4, 0.4, 0.4});
    for (glm::ivec3& t : mixed.triangles)
        std::swap(t.y, t.z);
    addBox(mixed, {0.6, 0, 0}, {1.2, 0.6, 0.6});
    check("one of two inside out", mixed);
}

TEST_CASE("grid lines through edges, corners and faces keep the signs", "[distanceField]") {
    // every face lies on samples, and so do the diagonals of the faces
    const DistanceField field = bakeDistanceField(boxMesh({0, 0, 0}, {1, 1, 1}), resolution(16));
    for (int z = 0; z < field.grid.size.z; ++z)
        for (int y = 0; y < field.grid.size.y; ++y)
            for (int x = 0; x < field.grid.size.x; ++x) {
                const double exact = boxDistance({0, 0, 0}, {1, 1, 1}, field.grid.place(x, y, z));
                REQUIRE(double(field.distances[field.grid.index(x, y, z)]) == Approx(exact).margin(1e-6));
            }
}

TEST_CASE("lines through the corners and edges of an octahedron count once", "[distanceField]") {
    // in each coordinate plane all lines of the grid meet edges, and those through the middle meet corners
    Mesh mesh;
    addTriangles(mesh, "octahedron", {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                 {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
    completeMesh(mesh);
    const SampleGrid grid{{25, 25, 25}, glm::dvec3(-1.5), 0.125};
    const std::vector<int16_t> winding = windingNumbers(mesh, grid, 2);
    for (int z = 0; z < 25; ++z)
        for (int y = 0; y < 25; ++y)
            for (int x = 0; x < 25; ++x) {
                const glm::dvec3 p = glm::abs(grid.place(x, y, z));
                const double beyond = p.x + p.y + p.z - 1;
                if (beyond != 0) REQUIRE(winding[grid.index(x, y, z)] == (beyond < 0 ? 1 : 0));
            }
}

TEST_CASE("inside overlapping shells the depth is that of the outside", "[distanceField]") {
    // two boxes that make one: the walls between them are none
    Mesh mesh;
    addBox(mesh, {-1, -0.5, -0.5}, {0.3, 0.5, 0.5});
    addBox(mesh, {-0.3, -0.5, -0.5}, {1, 0.5, 0.5});
    completeMesh(mesh);
    const DistanceField field = bakeDistanceField(mesh, resolution(40));
    CHECK(worstSample(field, [](const glm::dvec3& x) {
              return boxDistance({-1, -0.5, -0.5}, {1, 0.5, 0.5}, x);
          }) < 1.5);
    for (double x : {-0.3, 0.0, 0.3})
        CHECK(valueAt(field, {x, 0, 0}).distance == Approx(-0.5).margin(1.5 * field.grid.cell));
}

TEST_CASE("what is not closed becomes a shell, and the warning says where", "[distanceField]") {
    Mesh mesh;
    addBox(mesh, {0, 0, 0}, {1, 0.5, 1}, "crate");
    mesh.triangles.erase(mesh.triangles.begin() + 3);  // half of the top
    mesh.objects[0].triangleCount = 11;
    completeMesh(mesh);
    FieldRequest request = resolution(32);
    const DistanceField field = bakeDistanceField(mesh, request);
    CHECK_FALSE(field.surface.closed());
    CHECK(field.surface.borders == 3);
    CHECK(field.shell == Approx(2.0 / 32));
    CHECK(worstSample(field, [&](const glm::dvec3& x) { return bruteDistance(mesh, x) - 1.0 / 32; }) < 1e-5);
    const std::vector<std::string> warnings = fieldWarnings(field, request);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("3 border edges, the first at (0.5, 0.25, 1) of \"crate\"") != std::string::npos);
    CHECK(warnings[0].find("0.0625 m thick") != std::string::npos);

    request.shell = 0.2;
    CHECK(bakeDistanceField(mesh, request).shell == 0.2);
    request.shell = 0.01;  // less than the grid holds
    const DistanceField thin = bakeDistanceField(mesh, request);
    CHECK(thin.shell == Approx(2.0 / 32));
    REQUIRE(fieldWarnings(thin, request).size() == 2);
    CHECK(fieldWarnings(thin, request)[1].find("resolution 200") != std::string::npos);
}

TEST_CASE("broken meshes are told apart", "[distanceField]") {
    Mesh turned = boxMesh({0, 0, 0}, {1, 1, 1});
    std::swap(turned.triangles[5].y, turned.triangles[5].z);
    const SurfaceReport report = examineSurface(turned);
    CHECK(report.turned == 3);
    CHECK(report.borders == 0);
    CHECK(whyOpen(report).find("3 edges between triangles that face opposite ways") == 0);

    Mesh fin = boxMesh({0, 0, 0}, {1, 1, 1});
    addTriangles(fin, "fin", {{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}}, {{0, 1, 2}});
    completeMesh(fin);
    CHECK(examineSurface(fin).branching == 1);
    CHECK(examineSurface(fin).borders == 2);

    Mesh sheet;  // two faces back to back
    addTriangles(sheet, "sheet", {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 1}});
    completeMesh(sheet);
    CHECK(examineSurface(sheet).unsound() == 0);
    CHECK_FALSE(examineSurface(sheet).closed());
    CHECK(whyOpen(examineSurface(sheet)) == "it encloses no volume");

    // a corner repeated is no edge; the rest stays closed
    Mesh sliver = boxMesh({0, 0, 0}, {1, 1, 1});
    sliver.triangles.push_back({0, 0, 1});
    completeMesh(sliver);
    CHECK(examineSurface(sliver).degenerate == 1);
    CHECK(examineSurface(sliver).closed());
    CHECK(wrongSigns(bakeDistanceField(sliver, resolution(16)), boxMesh({0, 0, 0}, {1, 1, 1}), 300) == 0);
}

TEST_CASE("a plate thinner than its cells is thickened so that nothing falls through", "[distanceField]") {
    for (bool turned : {false, true}) {
        const double height = 0.004;
        Mesh mesh;
        addBox(mesh, {-0.5, 0, -0.5}, {0.5, height, 0.5});
        completeMesh(mesh);
        glm::dvec3 up(0, 1, 0), side(0.3, 0, 0.2);
        if (turned) {
            mesh = turnedAndMoved(std::move(mesh), {0, 0, 0});
            const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3))));
            up = turn * up, side = turn * side;
        }
        INFO("turned " << turned);
        const FieldRequest request = resolution(40);
        const DistanceField field = bakeDistanceField(mesh, request);
        const double cell = field.grid.cell;
        CHECK(field.thinArea > 0.9);
        CHECK(field.thinnest == Approx(height).epsilon(1e-3));
        REQUIRE(fieldWarnings(field, request).size() == 1);
        CHECK(fieldWarnings(field, request)[0].find("thickened") != std::string::npos);
        // across it: inside in the middle, half a cell beside it the way out is right, and there is a surface
        for (const glm::dvec3& at : {glm::dvec3(0), side, -side}) {
            const glm::dvec3 middle = at + up * (height / 2);
            CHECK(valueAt(field, middle).distance < -0.1 * cell);
            for (int sign : {-1, 1}) {
                const FieldValue near = valueAt(field, middle + up * (sign * 0.9 * cell));
                CHECK(glm::dot(glm::normalize(near.gradient), up * double(sign)) > 0.9);
                CHECK(valueAt(field, middle + up * (sign * 1.0 * cell)).distance ==
                      Approx(0).margin(0.1 * cell));
                CHECK(valueAt(field, middle + up * (sign * 2.0 * cell)).distance ==
                      Approx(cell).margin(0.1 * cell));
            }
        }
    }
}

TEST_CASE("a single triangle is a shell", "[distanceField]") {
    Mesh mesh;
    addTriangles(mesh, "one", {{0, 0, 0}, {1, 0, 0.1}, {0.2, 0.7, 0.3}}, {{0, 1, 2}});
    completeMesh(mesh);
    const DistanceField field = bakeDistanceField(mesh, resolution(24));
    CHECK(field.surface.borders == 3);
    CHECK(worstSample(field, [&](const glm::dvec3& x) { return bruteDistance(mesh, x) - field.shell / 2; }) <
          1e-5);
}

TEST_CASE("tiny, huge and far models bake alike", "[distanceField]") {
    Mesh mesh;
    addTorus(mesh, {0, 0, 0}, 1, 0.35, 24, 12);
    completeMesh(mesh);
    const DistanceField plain = bakeDistanceField(mesh, resolution(16));
    for (const auto& [scale, by] : {std::pair(1e-6, glm::dvec3(0)), std::pair(1e9, glm::dvec3(0)),
                                    std::pair(1.0, glm::dvec3(1e5, -1e5, 3e4))}) {
        Mesh other = mesh;
        for (glm::dvec3& p : other.positions)
            p = p * scale + by;
        completeMesh(other);
        const DistanceField field = bakeDistanceField(other, resolution(16));
        REQUIRE(field.grid.size == plain.grid.size);
        double worst = 0;
        for (size_t i = 0; i < plain.distances.size(); ++i)
            worst =
                std::max(worst, std::abs(double(field.distances[i]) / scale - double(plain.distances[i])));
        INFO("scale " << scale);
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("an error bound refines the grid until it holds", "[distanceField]") {
    Mesh mesh;
    addSphere(mesh, {0, 0, 0}, 0.5, 48, 24);
    completeMesh(mesh);
    FieldRequest request;
    request.thickness = 0.01;
    request.error = 0.004;
    const DistanceField loose = bakeDistanceField(mesh, request);
    CHECK(loose.error.most <= 0.004);
    request.error = 0.001;
    const DistanceField tight = bakeDistanceField(mesh, request);
    CHECK(tight.error.most <= 0.001);
    CHECK(tight.resolution > loose.resolution);
    CHECK(tight.resolution < 96);
}

TEST_CASE("what cannot be baked says why, and what would fit", "[distanceField]") {
    Mesh flat;
    addTriangles(flat, "line", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
    completeMesh(flat);
    CHECK(messageOf([&] { bakeDistanceField(flat, {}); }).find("has no surface") != std::string::npos);
    const Mesh box = boxMesh({0, 0, 0}, {1, 1, 1});
    const std::string large = messageOf([&] { bakeDistanceField(box, resolution(300)); });
    CHECK(large.find("305 x 305 x 305 samples") != std::string::npos);
    CHECK(large.find("at most resolution 250 fits") != std::string::npos);
    CHECK(finestResolution(box, resolution(300), true) == 250);
    FieldRequest thick = resolution(32);
    thick.thickness = 1e4;
    CHECK(messageOf([&] { bakeDistanceField(box, thick); }).find("take too large a grid") !=
          std::string::npos);
}
