#include "molecule/gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace shoal {

namespace {

constexpr int mostCuts = 32;  // of an edge, by a lattice over its triangle

// Each from the lower of its vertices to the higher.
std::array<std::pair<int, int>, 3> edgesOf(const Triangle& t) {
    return {std::minmax(t.a, t.b), std::minmax(t.b, t.c), std::minmax(t.c, t.a)};
}

double lengthOf(const Molecule& molecule, int a, int b) {
    return glm::distance(molecule.vertices[size_t(a)].position, molecule.vertices[size_t(b)].position);
}

glm::dvec3 placeOf(const Molecule& molecule, const TrianglePoint& point) {
    glm::dvec3 out(0);
    for (int c = 0; c < 3; ++c)
        out += molecule.vertices[size_t(point.corners[c])].position * double(point.parts[c]);
    return out / double(point.parts.x + point.parts.y + point.parts.z);
}

// Appends the points along edge ab, without its ends.
void addEdge(const Molecule& molecule, int a, int b, double radius, std::vector<TrianglePoint>& points) {
    const int cuts = int(std::ceil(lengthOf(molecule, a, b) / (2 * radius)));
    for (int i = 1; i < cuts; ++i)
        points.push_back({{a, b, b}, {cuts - i, i, 0}});
}

// Appends points within a triangle, each where the gap is largest, as long as a like sphere passes that is a
// tenth smaller. `around`: the spheres on its edges.
void addInner(const Molecule& molecule, const Triangle& t, double radius, std::vector<glm::dvec3> around,
              std::vector<TrianglePoint>& points) {
    for (;;) {
        double largest = 2 * 0.9 * radius;
        std::optional<TrianglePoint> found;
        for (int i = 1; i < mostCuts; ++i) {
            for (int k = 1; k + i < mostCuts; ++k) {
                const TrianglePoint point{{t.a, t.b, t.c}, {mostCuts - i - k, i, k}};
                const glm::dvec3 place = placeOf(molecule, point);
                double nearest = 1e300;
                for (size_t s = 0; s < around.size() && nearest > largest; ++s)
                    nearest = std::min(nearest, glm::distance(place, around[s]));
                if (nearest <= largest) continue;
                largest = nearest;
                found = point;
            }
        }
        if (!found) return;
        points.push_back(*found);
        around.push_back(placeOf(molecule, *found));
    }
}

}  // namespace

std::vector<TrianglePoint> middlePoints(const Molecule& molecule) {
    std::vector<TrianglePoint> out;
    for (const Triangle& t : molecule.triangles)
        out.push_back({{t.a, t.b, t.c}, {1, 1, 1}});
    return out;
}

std::vector<TrianglePoint> closingPoints(const Molecule& molecule, double radius) {
    std::vector<TrianglePoint> out;
    std::set<std::pair<int, int>> edges;
    for (const Triangle& t : molecule.triangles)
        for (const auto& [a, b] : edgesOf(t))
            if (edges.emplace(a, b).second) addEdge(molecule, a, b, radius, out);
    for (const Triangle& t : molecule.triangles) {
        std::vector<TrianglePoint> border;
        for (const auto& [a, b] : edgesOf(t)) {
            border.push_back({{a, b, b}, {1, 0, 0}});
            border.push_back({{a, b, b}, {0, 1, 0}});
            addEdge(molecule, a, b, radius, border);
        }
        std::vector<glm::dvec3> around;
        for (const TrianglePoint& point : border)
            around.push_back(placeOf(molecule, point));
        addInner(molecule, t, radius, std::move(around), out);
    }
    return out;
}

double leastClosingRadius(const Molecule& molecule) {
    double longest = 0;
    for (const Triangle& t : molecule.triangles)
        for (const auto& [a, b] : edgesOf(t))
            longest = std::max(longest, lengthOf(molecule, a, b));
    return longest / mostCuts;
}

std::vector<glm::dvec3> restSpheres(const Molecule& molecule, const std::vector<TrianglePoint>& points) {
    std::vector<glm::dvec3> out;
    for (const Vertex& vertex : molecule.vertices)
        out.push_back(vertex.position);
    for (const TrianglePoint& point : points)
        out.push_back(placeOf(molecule, point));
    return out;
}

// On a lattice over each triangle: a hole's middle is a Voronoi vertex of the spheres, and a step of 1/64 of
// an edge is within what a radius is known to.
Gap largestGap(const Molecule& molecule, const std::vector<glm::dvec3>& spheres, double radius) {
    Gap out;
    // a shape with many spheres has small triangles
    const int cuts = spheres.size() > 200 ? 8 : mostCuts;
    for (size_t t = 0; t < molecule.triangles.size(); ++t) {
        const Triangle& triangle = molecule.triangles[t];
        const glm::dvec3 &a = spheres[size_t(triangle.a)], &b = spheres[size_t(triangle.b)],
                         &c = spheres[size_t(triangle.c)];
        for (int i = 0; i <= cuts; ++i) {
            for (int k = 0; k + i <= cuts; ++k) {
                const glm::dvec3 p = a + (b - a) * (double(i) / cuts) + (c - a) * (double(k) / cuts);
                // its own corners are mostly the nearest
                double nearest = std::min({glm::distance(p, a), glm::distance(p, b), glm::distance(p, c)});
                for (size_t s = 0; s < spheres.size() && nearest - radius > out.radius; ++s)
                    nearest = std::min(nearest, glm::distance(p, spheres[s]));
                if (nearest - radius > out.radius) out = {nearest - radius, int(t)};
            }
        }
    }
    return out;
}

double closingRadius(const Molecule& molecule, bool triangles) {
    const std::vector<glm::dvec3> spheres =
        restSpheres(molecule, triangles ? middlePoints(molecule) : std::vector<TrianglePoint>());
    if (spheres.size() == 1) return molecule.material.pointSize / 2;
    if (!molecule.triangles.empty()) return largestGap(molecule, spheres, 0).radius / 2;
    double out = 0;
    for (size_t a = 0; a < spheres.size(); ++a) {
        double nearest = 1e300;
        for (size_t b = 0; b < spheres.size(); ++b)
            if (b != a) nearest = std::min(nearest, glm::distance(spheres[a], spheres[b]));
        out = std::max(out, nearest / 2);
    }
    return out;
}

}  // namespace shoal
