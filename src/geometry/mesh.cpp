// Welding by position: files repeat a vertex for every normal, colour or uv that meets there, while
// placement, thickness and shading across seams need to know that it is one point.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "core/error.h"
#include "geometry/mesh.h"
#include "geometry/model_reader.h"

namespace shoal {

namespace {

struct CellHash {
    size_t operator()(const glm::i64vec3& c) const {
        const uint64_t mixed = static_cast<uint64_t>(c.x) * 0x9E3779B97F4A7C15u ^
                               static_cast<uint64_t>(c.y) * 0xC2B2AE3D27D4EB4Fu ^
                               static_cast<uint64_t>(c.z) * 0x165667B19E3779F9u;
        return static_cast<size_t>(mixed ^ (mixed >> 29));
    }
};

// Welded vertices by cell. A cell is several tolerances wide, so that nearly every lookup visits one.
class WeldGrid {
  public:
    WeldGrid(const glm::dvec3& low, double tolerance)
        : low_(low), tolerance_(tolerance), cell_(8 * tolerance) {}

    // The welded vertex within the tolerance of `position`, a new one when there is none.
    int find(const glm::dvec3& position, std::vector<glm::dvec3>& welded) {
        const glm::i64vec3 from = cellOf(position - tolerance_), to = cellOf(position + tolerance_);
        glm::i64vec3 c;
        for (c.z = from.z; c.z <= to.z; ++c.z)
            for (c.y = from.y; c.y <= to.y; ++c.y)
                for (c.x = from.x; c.x <= to.x; ++c.x) {
                    const auto found = first_.find(c);
                    if (found == first_.end()) continue;
                    for (int v = found->second; v >= 0; v = next_[size_t(v)])
                        if (glm::distance(welded[size_t(v)], position) <= tolerance_) return v;
                }
        const int vertex = static_cast<int>(welded.size());
        welded.push_back(position);
        const auto [entry, isNew] = first_.try_emplace(cellOf(position), vertex);
        next_.push_back(isNew ? -1 : entry->second);
        entry->second = vertex;
        return vertex;
    }

  private:
    glm::i64vec3 cellOf(const glm::dvec3& position) const {
        return glm::i64vec3(glm::floor((position - low_) / cell_));
    }

    glm::dvec3 low_;
    double tolerance_, cell_;
    std::unordered_map<glm::i64vec3, int, CellHash> first_;
    std::vector<int> next_;  // per welded vertex: the next in its cell, -1 at the end
};

// The triangle's normal times its angle at a corner: sums do not depend on how polygons were cut
// [Thuermer 1998]. On a three-sided twig a sum weighted by areas would lie along a side.
glm::dvec3 angleNormal(const Mesh& mesh, const glm::ivec3& t, int corner) {
    const glm::dvec3& point = mesh.positions[size_t(t[corner])];
    const glm::dvec3 next = mesh.positions[size_t(t[(corner + 1) % 3])] - point;
    const glm::dvec3 last = mesh.positions[size_t(t[(corner + 2) % 3])] - point;
    const glm::dvec3 across = glm::cross(next, last);
    const double sine = glm::length(across);
    if (!(sine > 0)) return glm::dvec3(0);
    return across / sine * std::atan2(sine, glm::dot(next, last));
}

}  // namespace

void completeMesh(Mesh& mesh) {
    if (mesh.positions.empty()) return;
    mesh.low = mesh.high = mesh.positions.front();
    for (const glm::dvec3& p : mesh.positions) {
        mesh.low = glm::min(mesh.low, p);
        mesh.high = glm::max(mesh.high, p);
    }
    const double diagonal = glm::distance(mesh.low, mesh.high);
    // Never below what doubles can tell apart this far from the origin.
    const glm::dvec3 reach = glm::max(glm::abs(mesh.low), glm::abs(mesh.high));
    const double tolerance =
        std::max({1e-6 * diagonal, 1e-15 * std::max({reach.x, reach.y, reach.z}), 1e-300});

    WeldGrid grid(mesh.low, tolerance);
    mesh.weld.clear();
    mesh.weldedPositions.clear();
    for (const glm::dvec3& p : mesh.positions)
        mesh.weld.push_back(grid.find(p, mesh.weldedPositions));

    std::vector<glm::dvec3> corner(mesh.positions.size(), glm::dvec3(0));
    mesh.weldedNormals.assign(mesh.weldedPositions.size(), glm::dvec3(0));
    for (const glm::ivec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 normal = angleNormal(mesh, t, i);
            corner[size_t(t[i])] += normal;
            mesh.weldedNormals[size_t(mesh.weld[size_t(t[i])])] += normal;
        }
    }
    if (mesh.triangles.empty() && !mesh.normals.empty())  // a cloud of points has what its file says
        for (size_t v = 0; v < mesh.normals.size(); ++v)
            mesh.weldedNormals[size_t(mesh.weld[v])] += mesh.normals[v];
    const glm::dvec3 up(0, 1, 0);
    for (glm::dvec3& n : mesh.weldedNormals)
        n = unit(n, up);
    mesh.normals.resize(mesh.positions.size(), glm::dvec3(0));
    for (size_t v = 0; v < mesh.normals.size(); ++v)
        if (mesh.normals[v] == glm::dvec3(0))
            mesh.normals[v] = unit(corner[v], mesh.weldedNormals[size_t(mesh.weld[v])]);
}

// ---- Whether a mesh encloses a volume

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

std::vector<MeshPiece> piecesByLook(const Mesh& mesh, std::vector<uint32_t>& corners) {
    std::vector<int> lookOf(mesh.triangles.size(), -1);
    for (const Mesh::Part& part : mesh.parts)
        std::fill_n(lookOf.begin() + part.firstTriangle, part.triangleCount, part.look);
    std::vector<size_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return lookOf[a] < lookOf[b]; });
    std::vector<MeshPiece> out;
    corners.clear();
    corners.reserve(3 * order.size());
    for (const size_t i : order) {
        if (out.empty() || out.back().look != lookOf[i]) out.push_back({lookOf[i], corners.size(), 0});
        out.back().count += 3;
        for (int k = 0; k < 3; ++k)
            corners.push_back(uint32_t(mesh.triangles[i][k]));
    }
    return out;
}

}  // namespace shoal
