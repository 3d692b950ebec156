// Meshes with more vertices keep their shape and what their vertices and parts carry.
#include "geometry/subdivide.h"

#include <chrono>

#include "support/catch.h"

using namespace shoal;

namespace {

// Two flags of two triangles beside each other, in two parts; the first with a seam in its uvs.
Mesh flags() {
    Mesh mesh;
    for (const double x : {0.0, 5.0})
        for (const glm::dvec2 corner : {glm::dvec2(0, 0), {2, 0}, {2, 1}, {0, 1}})
            mesh.positions.emplace_back(x + corner.x, corner.y, 0), mesh.uvs.push_back(corner);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    mesh.objects = {{"all", 0, 4}};
    mesh.parts = {{"left", "", 0, 2, -1}, {"right", "", 2, 2, -1}};
    completeMesh(mesh);
    return mesh;
}

double areaOf(const Mesh& mesh, const Mesh::Part& part) {
    double out = 0;
    for (int t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
        const glm::ivec3& corners = mesh.triangles[size_t(t)];
        const auto place = [&](int corner) { return mesh.positions[size_t(corner)]; };
        out += 0.5 * glm::length(glm::cross(place(corners.y) - place(corners.x),
                                            place(corners.z) - place(corners.x)));
    }
    return out;
}

}  // namespace

TEST_CASE("halving edges keeps shape, parts and what vertices carry", "[mesh]") {
    Mesh mesh = flags();
    subdivide(mesh, 50, 1000);
    CHECK(mesh.weldedPositions.size() == 50);
    CHECK(mesh.triangles.size() > 50);
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[0].firstTriangle == 0);
    CHECK(mesh.parts[1].firstTriangle == mesh.parts[0].triangleCount);
    CHECK(mesh.parts[0].triangleCount + mesh.parts[1].triangleCount == int(mesh.triangles.size()));
    CHECK(mesh.objects[0].triangleCount == int(mesh.triangles.size()));
    for (const Mesh::Part& part : mesh.parts)
        CHECK(areaOf(mesh, part) == Approx(2));
    double longest = 0;
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            longest = std::max(
                longest, glm::distance(mesh.positions[size_t(t[i])], mesh.positions[size_t(t[(i + 1) % 3])]));
    CHECK(longest < 0.8);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const double left = mesh.positions[i].x < 3 ? 0 : 5;
        CHECK(glm::distance(mesh.uvs[i], glm::dvec2(mesh.positions[i]) - glm::dvec2(left, 0)) < 1e-12);
        CHECK(mesh.normals[i] == glm::dvec3(0, 0, 1));
    }
    // no vertex lies within another triangle's edge: neighbours were halved together
    const SurfaceReport report = examineSurface(mesh);
    CHECK(report.branching == 0);
    CHECK(report.area == Approx(4));
}

TEST_CASE("what has enough vertices, or no area, stays as it is", "[mesh]") {
    Mesh mesh = flags();
    subdivide(mesh, 8, 1000);
    CHECK(mesh.triangles.size() == 4);
    Mesh line;
    line.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    line.triangles = {{0, 1, 2}};
    completeMesh(line);
    subdivide(line, 10, 1000);
    CHECK(line.triangles.size() == 1);
}

TEST_CASE("an edge of very many triangles is halved as fast as as many edges", "[mesh]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(20'000, {0, 1, 2});
    completeMesh(mesh);
    Mesh other = mesh;
    const auto start = std::chrono::steady_clock::now();
    subdivide(mesh, 12, 10'000'000);
    // A hundred times as long where each triangle is looked for among the others.
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
    CHECK(mesh.weldedPositions.size() == 12);
    CHECK(mesh.triangles.size() % 20'000 == 0);
    double area = 0;
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[size_t(t.x)];
        area +=
            0.5 * glm::length(glm::cross(mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a));
    }
    CHECK(area == Approx(10'000));
    subdivide(other, 12, 30'000);  // the next edge would make 40,000
    CHECK(other.triangles.size() == 20'000);
}
