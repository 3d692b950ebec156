#include <algorithm>

#include "core/error.h"
#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// A unit cube with a normal per face, so that every corner appears three times.
const char* cube = R"(o cube
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 1 1 1
v 0 0 1 1 0 0
v 1 0 1 0 1 0
v 1 1 1 0 0 1
v 0 1 1 0.5 0.25 0
vn 0 0 -1
vn 0 0 1
vn -1 0 0
vn 1 0 0
vn 0 -1 0
vn 0 1 0
f 1//1 4//1 3//1 2//1
f 5//2 6//2 7//2 8//2
f 1//3 5//3 8//3 4//3
f 2//4 3//4 7//4 6//4
f 1//5 2//5 6//5 5//5
f 4//6 8//6 7//6 3//6
)";

// One triangle under two nodes: the outer one scales x by 2 and shifts, the inner one turns about z.
std::string nestedGltf() {
    const float d = 0.70710678f;  // the normals lean, so that scaling turns them
    GltfText file;
    file.points({0, 0, 0, 1, 0, 0, 0, 1, 0});
    file.points({d, d, 0, d, d, 0, d, d, 0});
    return file.text(R"("scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"name": "outer", "translation": [10, 0, 0], "scale": [2, 1, 1], "children": [1]},
          {"name": "inner", "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "mesh": 0}],
"meshes": [{"name": "wing", "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}])");
}

void checkClose(const glm::dvec3& a, const glm::dvec3& b) {
    CHECK(a.x == Approx(b.x).margin(1e-6));
    CHECK(a.y == Approx(b.y).margin(1e-6));
    CHECK(a.z == Approx(b.z).margin(1e-6));
}

}  // namespace

TEST_CASE("a cube of quads welds to eight vertices", "[model]") {
    const Scratch scratch;
    const Mesh mesh = loadMesh(scratch.write("cube.obj", cube));
    CHECK(mesh.triangles.size() == 12);
    CHECK(mesh.positions.size() == 24);
    CHECK(mesh.weldedPositions.size() == 8);
    CHECK(mesh.weld.size() == mesh.positions.size());
    for (size_t corner = 0; corner < mesh.weld.size(); ++corner)
        CHECK(mesh.weldedPositions[size_t(mesh.weld[corner])] == mesh.positions[corner]);
    REQUIRE(mesh.objects.size() == 1);
    CHECK(mesh.objects[0].name == "cube");
    CHECK(mesh.objects[0].triangleCount == 12);
    checkClose(mesh.low, {0, 0, 0});
    checkClose(mesh.high, {1, 1, 1});

    // Corner normals are the file's; welded normals lean outward from the middle.
    for (size_t v = 0; v < mesh.weldedPositions.size(); ++v)
        CHECK(glm::dot(mesh.weldedNormals[v], mesh.weldedPositions[v] - 0.5) > 0.7);
    for (const glm::dvec3& n : mesh.normals)
        CHECK(std::abs(n.x) + std::abs(n.y) + std::abs(n.z) == Approx(1));

    // Vertex colours of an OBJ are sRGB and become linear.
    REQUIRE(mesh.colors.size() == mesh.positions.size());
    for (size_t corner = 0; corner < mesh.weld.size(); ++corner)
        if (mesh.positions[corner] == glm::dvec3(0, 1, 1))
            checkClose(mesh.colors[corner], {0.2140411, 0.0508761, 0});
}

TEST_CASE("nested node transforms move positions and normals", "[model]") {
    const Scratch scratch;
    const Mesh mesh = loadMesh(scratch.write("nested.gltf", nestedGltf()));
    REQUIRE(mesh.positions.size() == 3);
    // The inner turn takes +X to +Y and +Y to -X, then x doubles and shifts by 10.
    checkClose(mesh.positions[0], {10, 0, 0});
    checkClose(mesh.positions[1], {10, 1, 0});
    checkClose(mesh.positions[2], {8, 0, 0});
    // (1, 1) turns to (-1, 1); the inverse transpose halves x.
    checkClose(mesh.normals[0], glm::normalize(glm::dvec3(-0.5, 1, 0)));
    REQUIRE(mesh.objects.size() == 1);
    CHECK(mesh.objects[0].name == "inner");
}

TEST_CASE("a mirroring node keeps the front in front", "[model]") {
    const Scratch scratch;
    std::string text = nestedGltf();
    text.replace(text.find("[2, 1, 1]"), 9, "[-1, 1, 1]");
    const Mesh mesh = loadMesh(scratch.write("mirrored.gltf", text));
    REQUIRE(mesh.triangles.size() == 1);
    checkClose(mesh.weldedNormals[0], {0, 0, 1});
}

TEST_CASE("lines and points are left out", "[model]") {
    const Scratch scratch;
    const Mesh mesh = loadMesh(scratch.write("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n"));
    CHECK(mesh.triangles.size() == 1);
    checkClose(mesh.normals[0], {0, 0, 1});  // from the triangle, as the file has none
}

TEST_CASE("vertices within the tolerance weld, others do not", "[model]") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1 + 1e-7, 0, 0}, {1, 1, 0}, {0, 1 + 1e-4, 0}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    completeMesh(mesh);
    CHECK(mesh.weldedPositions.size() == 5);
    CHECK(mesh.weld[1] == mesh.weld[3]);
    CHECK(mesh.weld[2] != mesh.weld[5]);
}

TEST_CASE("a mesh of one point welds to one vertex", "[model]") {
    Mesh mesh;
    mesh.positions.assign(3, glm::dvec3(1e6, 2, 3));
    mesh.triangles = {{0, 1, 2}};
    completeMesh(mesh);
    CHECK(mesh.weldedPositions.size() == 1);
    CHECK(mesh.weldedNormals[0] == glm::dvec3(0, 1, 0));
}

TEST_CASE("files that are not models say so", "[model]") {
    const Scratch scratch;
    const auto message = [](const std::string& file) -> std::string {
        try {
            loadMesh(file);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    using Catch::Contains;
    CHECK_THAT(message(scratch.path("none.obj")), Contains("none.obj: no such file"));
    CHECK_THAT(message(scratch.path("")), Contains("is a folder"));
    CHECK_THAT(message(scratch.write("a.txt", "hello")), Contains("a.txt: cannot be read as a model: "));
    CHECK_THAT(message(scratch.write("a.gltf", "{\"asset\": ")), Contains("a.gltf:1: "));
    CHECK_THAT(message(scratch.write("none.obj", "# nothing\n")),
               Contains("has no triangles, expected a mesh with at least one"));
    CHECK_THAT(message(scratch.write("nan.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n")),
               Contains("is not finite, expected three finite numbers"));
}
