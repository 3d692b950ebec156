// Coincident walls: which of them stay.
#include <algorithm>
#include <array>
#include <functional>

#include "author/from_mesh.h"
#include "geometry/doubled_walls.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Four corners, anticlockwise from the front, cut along one diagonal or the other.
void addQuad(Mesh& mesh, const std::array<glm::dvec3, 4>& corners, bool other) {
    const std::vector<glm::dvec3> places(corners.begin(), corners.end());
    addTriangles(mesh, "quad", places,
                 other ? std::vector<glm::ivec3>{{1, 2, 3}, {1, 3, 0}}
                       : std::vector<glm::ivec3>{{0, 1, 2}, {0, 2, 3}});
}

// A cube of 1 m with its own corners.
void addCube(Mesh& mesh, const glm::dvec3& low, bool other = false) {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {0.0, 1.0}) {
            glm::dvec3 u(0), v(0), n(0);
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = n[axis] = 1;
            const glm::dvec3 at = low + side * n;
            if (side > 0)
                addQuad(mesh, {at, at + u, at + u + v, at + v}, other);
            else
                addQuad(mesh, {at, at + v, at + u + v, at + u}, other);
        }
}

// A sheet of 2 by 2 squares in z = 0.
void addSheet(Mesh& mesh, bool turned, bool other = false) {
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) {
            const glm::dvec3 a(x, y, 0), b(x + 1, y, 0), c(x + 1, y + 1, 0), d(x, y + 1, 0);
            if (turned)
                addQuad(mesh, {a, d, c, b}, other);
            else
                addQuad(mesh, {a, b, c, d}, other);
        }
}

void addTetrahedron(Mesh& mesh, std::array<glm::dvec3, 4> p) {
    if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) > 0) std::swap(p[1], p[2]);
    addTriangles(mesh, "tetrahedron", {p[0], p[1], p[2], p[3]}, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
}

Mesh voxels(int x, int y, int z, bool mixed) {
    Mesh mesh;
    for (int i = 0; i < x; ++i)
        for (int j = 0; j < y; ++j)
            for (int k = 0; k < z; ++k)
                addCube(mesh, {i, j, k}, mixed && (i + j + k) % 2);
    completeMesh(mesh);
    return mesh;
}

Mesh together(const std::function<void(Mesh&)>& add) {
    Mesh mesh;
    add(mesh);
    completeMesh(mesh);
    return mesh;
}

struct Rest {
    size_t triangles = 0;
    SurfaceReport surface;
};
Rest restOf(const Mesh& mesh) {
    Mesh rest = mesh;
    rest.triangles.clear();
    rest.objects.clear();
    const std::vector<char> doubled = doubledWalls(mesh);
    for (size_t t = 0; t < doubled.size(); ++t)
        if (!doubled[t]) rest.triangles.push_back(mesh.triangles[t]);
    return {rest.triangles.size(), examineSurface(rest)};
}

}  // namespace

TEST_CASE("solids that share walls are one body", "[walls]") {
    struct Case {
        const char* name;
        Mesh mesh;
        size_t triangles;
        double volume;
    };
    const std::array<glm::dvec3, 5> p = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
    const Case cases[] = {
        {"two cubes", voxels(2, 1, 1, false), 20, 2},
        {"two cubes cut along other diagonals", voxels(2, 1, 1, true), 20, 2},
        {"voxels", voxels(3, 3, 3, false), 6 * 9 * 2, 27},
        {"voxels cut along other diagonals", voxels(3, 2, 2, true), 2 * (6 + 6 + 4) * 2, 12},
        {"joined tetrahedra", together([&](Mesh& mesh) {
             addTetrahedron(mesh, {p[0], p[1], p[2], p[3]});
             addTetrahedron(mesh, {p[4], p[1], p[2], p[3]});
         }),
         6, 0.5},
        {"a ball that fills a hollow one", together([](Mesh& mesh) {
             addSphere(mesh, glm::dvec3(0), 2, 12, 8);
             Mesh inner;
             addSphere(inner, glm::dvec3(0), 1, 12, 8);
             addTriangles(mesh, "filling", inner.positions, inner.triangles);
             for (glm::ivec3& t : inner.triangles)
                 std::swap(t.y, t.z);
             addTriangles(mesh, "hollow", inner.positions, inner.triangles);
         }),
         12 * 7 * 2, 0},
    };
    for (const Case& one : cases) {
        INFO(one.name);
        const Rest rest = restOf(one.mesh);
        CHECK(rest.triangles == one.triangles);
        CHECK(rest.surface.closed());
        if (one.volume > 0) CHECK(rest.surface.volume == Approx(one.volume).epsilon(1e-12));
    }
}

TEST_CASE("a sheet with two faces stays one, beside a solid and where its faces are cut otherwise",
          "[walls]") {
    for (const bool other : {false, true}) {
        INFO(other);
        const Mesh sheet = together([&](Mesh& mesh) { addSheet(mesh, false), addSheet(mesh, true, other); });
        Rest rest = restOf(sheet);
        CHECK(rest.triangles == 8);
        CHECK(rest.surface.area == Approx(4));

        // It hangs on an edge of a cube.
        const Mesh fin = together([&](Mesh& mesh) {
            addSheet(mesh, false), addSheet(mesh, true, other);
            addCube(mesh, {-1, 0, 0});
        });
        rest = restOf(fin);
        CHECK(rest.triangles == 20);
        CHECK(rest.surface.area == Approx(6 + 4));
    }
    // A ball that is drawn from within as well.
    Mesh ball;
    addSphere(ball, glm::dvec3(0), 1, 12, 8);
    Mesh both = ball;
    for (glm::ivec3& t : both.triangles)
        std::swap(t.y, t.z);
    addTriangles(both, "outside", ball.positions, ball.triangles);
    completeMesh(ball), completeMesh(both);
    const Rest rest = restOf(both);
    CHECK(rest.triangles == ball.triangles.size());
    CHECK(rest.surface.volume == Approx(examineSurface(ball).volume));  // its outside
}

TEST_CASE("of triangles that lie on one another and face one way the first stays", "[walls]") {
    Mesh mesh = voxels(1, 1, 1, false);
    const std::vector<glm::ivec3> once = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
    mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
    const std::vector<char> doubled = doubledWalls(mesh);
    CHECK(std::count(doubled.begin(), doubled.begin() + 12, 1) == 0);
    CHECK(std::count(doubled.begin(), doubled.end(), 1) == 24);
    // Two that face outwards and one that faces inwards leave one that faces outwards.
    mesh.triangles.resize(24);
    for (size_t t = 0; t < 12; ++t)
        mesh.triangles.push_back({once[t].x, once[t].z, once[t].y});
    const Rest rest = restOf(mesh);
    CHECK(rest.triangles == 12);
    CHECK(rest.surface.volume == Approx(1));
}

TEST_CASE("two cubes that share a face weigh as one body", "[walls][from-mesh]") {
    FromMesh options;
    options.name = "cubes";
    const MadeMolecule made = makeMolecule(voxels(2, 1, 1, false), options);
    CHECK(made.solid);
    CHECK(made.volume == Approx(2));
    double mass = 0;
    for (const Vertex& vertex : made.molecule.vertices)
        mass += vertex.mass;
    CHECK(mass == Approx(2100).epsilon(0.01));
}
