#include "author/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace shoal {

namespace {

int addVertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec2& uv) {
    mesh.positions.push_back(position);
    mesh.uvs.push_back(uv);
    return int(mesh.positions.size()) - 1;
}

void addQuad(Mesh& mesh, int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
}

// Folded along its middle, as a leaf is: flat, nothing of it would resist bending.
Mesh sheet(int n) {
    Mesh mesh;
    constexpr double slope = 0.25;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const glm::dvec2 uv(double(i) / n, double(j) / n);
            addVertex(mesh, {uv.x - 0.5, slope * std::abs(uv.x - 0.5), 0.5 - uv.y}, uv);
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            addQuad(mesh, a, a + 1, a + n + 2, a + n + 1);
        }
    return mesh;
}

// A cube of n x n squares a side.
Mesh box(int n) {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const int first = int(mesh.positions.size());
            for (int j = 0; j <= n; ++j)
                for (int i = 0; i <= n; ++i) {
                    const glm::dvec2 uv(double(i) / n, double(j) / n);
                    glm::dvec3 place(0);
                    place[axis] = 0.5 * side;
                    place[(axis + 1) % 3] = side * (uv.x - 0.5);
                    place[(axis + 2) % 3] = uv.y - 0.5;
                    addVertex(mesh, place, uv);
                }
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const int a = first + j * (n + 1) + i;
                    addQuad(mesh, a, a + 1, a + n + 2, a + n + 1);
                }
        }
    return mesh;
}

Mesh tetrahedron(int) {
    Mesh mesh;
    const double s = 0.5 / std::numbers::sqrt2;
    for (const glm::dvec3& corner :
         {glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, -1), glm::dvec3(1, -1, -1), glm::dvec3(-1, -1, 1)})
        addVertex(mesh, s * corner, glm::dvec2(corner) * 0.5 + 0.5);
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

// Rings of four about the x axis; `halves`: half the height and width of each.
Mesh rings(const std::vector<glm::dvec2>& halves) {
    Mesh mesh;
    const int n = int(halves.size()) - 1;
    constexpr glm::ivec2 corners[4] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};  // of y and z
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < 4; ++k)
            addVertex(
                mesh,
                {0.5 - double(i) / n, halves[size_t(i)].x * corners[k].x, halves[size_t(i)].y * corners[k].y},
                {double(i) / n, k / 4.0});
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) {
            const int a = 4 * i + k, b = 4 * i + (k + 1) % 4;
            // left and right, top and bottom alike: else what flows along would roll it
            if (k % 2 == 0)
                addQuad(mesh, a, b, b + 4, a + 4);
            else
                addQuad(mesh, b, b + 4, a + 4, a);
        }
    addQuad(mesh, 3, 2, 1, 0);
    addQuad(mesh, 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3);
    return mesh;
}

Mesh rod(int n) {
    return rings(std::vector<glm::dvec2>(size_t(n) + 1, glm::dvec2(0.06)));
}

// A body highest a third behind the head, a narrow stalk, and a fin that is high and thin; along +Z, as what
// swims does.
Mesh fish(int n) {
    std::vector<glm::dvec2> halves;
    for (int i = 0; i <= n; ++i) {
        const double s = double(i) / n;
        const double body = 0.17 * std::pow(std::sin(std::numbers::pi * std::pow(0.05 + 0.8 * s, 0.75)), 0.8);
        const double fin = s > 0.85 ? 0.14 * (s - 0.85) / 0.15 : 0;
        halves.emplace_back(std::max(body + fin, 0.02), std::max(0.55 * body, 0.01));
    }
    Mesh mesh = rings(halves);
    turnForward(mesh, {1, 0, 0});
    return mesh;
}

// Two sheets through one another, along the x axis.
Mesh cross(int n) {
    Mesh mesh;
    constexpr double half = 0.25;
    for (int i = 0; i <= n; ++i) {
        const double s = double(i) / n;
        addVertex(mesh, {s - 0.5, 0, 0}, {s, 0.5});
        for (const glm::dvec2 side : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}})
            addVertex(mesh, {s - 0.5, half * side.x, half * side.y}, {s, 0.5 + 0.5 * (side.x + side.y)});
    }
    for (int i = 0; i < n; ++i)
        for (int wing = 1; wing <= 4; ++wing)
            addQuad(mesh, 5 * i, 5 * i + 5, 5 * i + 5 + wing, 5 * i + wing);
    return mesh;
}

using Make = Mesh (*)(int);
constexpr std::array<Make, 6> makers = {sheet, rod, box, cross, tetrahedron, fish};

}  // namespace

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {
        {"sheet", "leaf", 2, 14},  {"rod", "flesh", 4, 55},        {"box", "flesh", 1, 6},
        {"cross", "flesh", 2, 44}, {"tetrahedron", "flesh", 1, 1}, {"fish", "flesh", 5, 55, true},
    };
    return all;
}

std::vector<std::string> shapeNames() {
    std::vector<std::string> out;
    for (const Shape& shape : shapes())
        out.emplace_back(shape.name);
    return out;
}

const Shape& shapeNamed(std::string_view name) {
    for (const Shape& shape : shapes())
        if (name == shape.name) return shape;
    throw Error(concat("unknown shape \"", name, "\"", suggestion(std::string(name), shapeNames())));
}

void checkDivisions(const Shape& shape, int divisions) {
    if (divisions < 1 || divisions > shape.mostDivisions)
        throw Error("a ", shape.name, " takes 1 to ", shape.mostDivisions, " divisions, found ", divisions);
}

Mesh shapeMesh(const Shape& shape, int divisions) {
    checkDivisions(shape, divisions);
    Mesh mesh = makers[size_t(&shape - shapes().data())](divisions);
    mesh.objects = {{shape.name, 0, int(mesh.triangles.size())}};
    completeMesh(mesh);
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    for (auto* places : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& place : *places)
            place /= size;
    mesh.low /= size;
    mesh.high /= size;
    return mesh;
}

FromMesh ofShape(const Shape& shape, const Mesh& mesh, FromMesh asked) {
    constexpr double usualSize = 0.2;  // m
    asked.size = asked.size.value_or(usualSize);
    asked.vertices = std::max(int(mesh.weldedPositions.size()), leastMadeVertices);
    asked.skin = false;
    asked.swims = shape.swims;
    if (asked.material.empty()) asked.material = shape.material;
    return asked;
}

}  // namespace shoal
