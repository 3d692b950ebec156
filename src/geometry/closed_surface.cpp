#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace shoal {

namespace {

// One side of a triangle. Sorted, the sides of an edge lie together.
struct Side {
    int low, high;  // welded vertices
    int triangle;
    bool forwards;  // from low to high
    bool operator<(const Side& o) const {
        return low != o.low ? low < o.low : high != o.high ? high < o.high : triangle < o.triangle;
    }
};

std::string objectOf(const Mesh& mesh, int triangle) {
    for (const Mesh::Object& object : mesh.objects)
        if (triangle >= object.firstTriangle && triangle < object.firstTriangle + object.triangleCount)
            return object.name;
    return {};
}

void examineEdges(const Mesh& mesh, std::vector<Side>& sides, SurfaceReport& report) {
    std::sort(sides.begin(), sides.end());
    int first = -1;  // triangle of the first unsound edge in the order of the file
    for (size_t from = 0, to; from < sides.size(); from = to) {
        int forwards = 0, backwards = 0;
        for (to = from;
             to < sides.size() && sides[to].low == sides[from].low && sides[to].high == sides[from].high;
             ++to)
            ++(sides[to].forwards ? forwards : backwards);
        if (forwards == backwards) continue;
        const int count = forwards + backwards;
        ++(count == 1 ? report.borders : count == 2 ? report.turned : report.branching);
        if (first >= 0 && sides[from].triangle >= first) continue;
        first = sides[from].triangle;
        report.where =
            (mesh.weldedPositions[size_t(sides[from].low)] + mesh.weldedPositions[size_t(sides[from].high)]) /
            2.0;
    }
    if (first >= 0) report.object = objectOf(mesh, first);
}

}  // namespace

SurfaceReport examineSurface(const Mesh& mesh) {
    SurfaceReport report;
    report.triangles = mesh.triangles.size();
    const glm::dvec3 middle = (mesh.low + mesh.high) / 2.0, extent = mesh.high - mesh.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        int v[3];
        glm::dvec3 p[3];
        for (int i = 0; i < 3; ++i) {
            v[i] = mesh.weld[size_t(mesh.triangles[t][i])];
            p[i] = (mesh.weldedPositions[size_t(v[i])] - middle) / (size > 0 ? size : 1);
        }
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            ++report.degenerate;
            continue;
        }
        report.area += glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
        report.volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
        for (int i = 0; i < 3; ++i) {
            const int a = v[i], b = v[(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), int(t), a < b});
        }
    }
    examineEdges(mesh, sides, report);
    report.hollow = std::abs(report.volume) < 1e-6 * report.area;
    report.area *= size * size;
    report.volume *= size * size * size;
    return report;
}

std::string whyOpen(const SurfaceReport& report) {
    std::vector<std::string> parts;
    if (report.borders) parts.push_back(many(report.borders, "border edge", "border edges"));
    if (report.turned)
        parts.push_back(many(report.turned, "edge between triangles that face opposite ways",
                             "edges between triangles that face opposite ways"));
    if (report.branching)
        parts.push_back(
            many(report.branching, "edge of three or more triangles", "edges of three or more triangles"));
    if (parts.empty()) return "it encloses no volume";
    std::string out;
    for (size_t i = 0; i < parts.size(); ++i)
        out += concat(i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ", parts[i]);
    out += concat(report.unsound() == 1 ? ", at (" : ", the first at (", report.where.x, ", ", report.where.y,
                  ", ", report.where.z, ")");
    if (!report.object.empty()) out += concat(" of \"", report.object, "\"");
    return out;
}

}  // namespace shoal
