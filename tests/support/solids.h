// Closed meshes made in code, anticlockwise as seen from outside, and their exact distances.
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/mesh.h"

namespace shoal::test {

inline void addTriangles(Mesh& mesh, const std::string& name, const std::vector<glm::dvec3>& positions,
                         const std::vector<glm::ivec3>& triangles) {
    const int first = int(mesh.positions.size());
    mesh.objects.push_back({name, int(mesh.triangles.size()), int(triangles.size())});
    mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
    for (const glm::ivec3& t : triangles)
        mesh.triangles.push_back(t + first);
}

inline void addBox(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high,
                   const std::string& name = "box") {
    std::vector<glm::dvec3> p;
    for (int i = 0; i < 8; ++i)
        p.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    addTriangles(mesh, name, p,
                 {{0, 2, 3},
                  {0, 3, 1},
                  {4, 5, 7},
                  {4, 7, 6},
                  {0, 1, 5},
                  {0, 5, 4},
                  {2, 6, 7},
                  {2, 7, 3},
                  {0, 4, 6},
                  {0, 6, 2},
                  {1, 3, 7},
                  {1, 7, 5}});
}

// `around` and `along` wrap: a torus with its axis along y.
inline void addTorus(Mesh& mesh, const glm::dvec3& center, double radius, double tube, int around,
                     int along) {
    std::vector<glm::dvec3> p;
    std::vector<glm::ivec3> t;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < along; ++j) {
            const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along;
            const double r = radius + tube * std::cos(b);
            p.push_back(center + glm::dvec3(r * std::cos(a), tube * std::sin(b), r * std::sin(a)));
        }
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < along; ++j) {
            const int k = (i + 1) % around, l = (j + 1) % along;
            t.push_back({i * along + j, i * along + l, k * along + l});
            t.push_back({i * along + j, k * along + l, k * along + j});
        }
    addTriangles(mesh, "torus", p, t);
}

// Rings of latitude about the y axis, the poles single vertices.
inline void addSphere(Mesh& mesh, const glm::dvec3& center, double radius, int sides, int rings) {
    std::vector<glm::dvec3> p{center + glm::dvec3(0, radius, 0)};
    std::vector<glm::ivec3> t;
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < sides; ++j) {
            const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / sides;
            p.push_back(center + radius * glm::dvec3(std::sin(a) * std::cos(b), std::cos(a),
                                                     -std::sin(a) * std::sin(b)));
        }
    const int south = int(p.size());
    p.push_back(center - glm::dvec3(0, radius, 0));
    for (int j = 0; j < sides; ++j) {
        const int k = (j + 1) % sides;
        t.push_back({0, 1 + j, 1 + k});
        for (int i = 0; i + 2 < rings; ++i) {
            const int a = 1 + i * sides, b = a + sides;
            t.push_back({a + j, b + j, b + k});
            t.push_back({a + j, b + k, a + k});
        }
        const int last = 1 + (rings - 2) * sides;
        t.push_back({south, last + k, last + j});
    }
    addTriangles(mesh, "sphere", p, t);
}

inline Mesh boxMesh(const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    addBox(mesh, low, high);
    completeMesh(mesh);
    return mesh;
}

inline double boxDistance(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& x) {
    const glm::dvec3 q = glm::abs(x - (low + high) / 2.0) - (high - low) / 2.0;
    return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// The generalised winding number: solid angles over 4 pi [van Oosterom 1983], [Jacobson 2013].
inline double solidAngles(const Mesh& mesh, const glm::dvec3& x) {
    double sum = 0;
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[size_t(t.x)] - x, b = mesh.positions[size_t(t.y)] - x,
                         c = mesh.positions[size_t(t.z)] - x;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum / (4 * std::numbers::pi);
}

// Brute force, after the regions of [Ericson 2005], which the library does not use.
inline double bruteDistance(const Mesh& mesh, const glm::dvec3& x) {
    double least = 1e300;
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[size_t(t.x)], b = mesh.positions[size_t(t.y)],
                         c = mesh.positions[size_t(t.z)];
        const glm::dvec3 ab = b - a, ac = c - a;
        const double d1 = glm::dot(ab, x - a), d2 = glm::dot(ac, x - a), d3 = glm::dot(ab, x - b),
                     d4 = glm::dot(ac, x - b), d5 = glm::dot(ab, x - c), d6 = glm::dot(ac, x - c);
        const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
        glm::dvec3 q;
        if (d1 <= 0 && d2 <= 0)
            q = a;
        else if (d3 >= 0 && d4 <= d3)
            q = b;
        else if (d6 >= 0 && d5 <= d6)
            q = c;
        else if (vc <= 0 && d1 >= 0 && d3 <= 0)
            q = a + ab * (d1 / (d1 - d3));
        else if (vb <= 0 && d2 >= 0 && d6 <= 0)
            q = a + ac * (d2 / (d2 - d6));
        else if (va <= 0 && d4 >= d3 && d5 >= d6)
            q = b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
        else
            q = a + ab * (vb / (va + vb + vc)) + ac * (vc / (va + vb + vc));
        least = std::min(least, glm::distance(q, x));
    }
    return least;
}

}  // namespace shoal::test
