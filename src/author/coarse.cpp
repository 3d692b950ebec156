#include "author/coarse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include <Eigen/Dense>

#include "core/parallel.h"
#include "geometry/mesh_levels.h"

namespace shoal {

namespace {

using Triangles = std::vector<unsigned>;  // three welded vertices each

constexpr double flat = 1e-3;  // smallest extent by largest: below, quadrics see a plane

// Welded, without triangles that have become edges.
Triangles weldedTriangles(const Mesh& mesh) {
    Triangles out;
    for (const glm::ivec3& t : mesh.triangles) {
        const std::array<int, 3> corners = {mesh.weld[size_t(t.x)], mesh.weld[size_t(t.y)],
                                            mesh.weld[size_t(t.z)]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        for (const int corner : corners)
            out.push_back(unsigned(corner));
    }
    return out;
}

size_t verticesOf(const Triangles& triangles) {
    return std::set<unsigned>(triangles.begin(), triangles.end()).size();
}

// By edge collapse, down to `most` vertices or as far as the topology lets it.
Triangles collapse(Triangles triangles, const std::vector<glm::vec3>& positions, size_t most) {
    // large meshes once, so that the search below is quick
    if (triangles.size() / 3 > 100 * most) triangles = collapseEdges(triangles, positions, 50 * most);
    Triangles best = triangles;
    for (size_t count = 2 * most; count >= 2 && verticesOf(best) > most; --count)
        best = collapseEdges(triangles, positions, count);
    return best;
}

// Seeds far from one another [Gonzalez 1985], every vertex to its nearest seed, and the triangles between
// three.
Triangles gather(const Triangles& triangles, const std::vector<glm::dvec3>& positions, size_t most) {
    const std::set<unsigned> used(triangles.begin(), triangles.end());
    std::vector<unsigned> nearest(positions.size(), 0);
    std::vector<double> distance(positions.size(), std::numeric_limits<double>::infinity());
    glm::dvec3 middle(0);
    for (const unsigned v : used)
        middle += positions[v] / double(used.size());
    unsigned seed = *used.begin();
    for (const unsigned v : used)
        if (glm::distance(positions[v], middle) > glm::distance(positions[seed], middle)) seed = v;
    for (size_t count = 0; count < std::min(most, used.size()); ++count) {
        unsigned next = seed;
        double farthest = -1;
        for (const unsigned v : used) {
            const double d = glm::distance(positions[v], positions[seed]);
            if (d < distance[v]) distance[v] = d, nearest[v] = seed;
            if (distance[v] > farthest) farthest = distance[v], next = v;
        }
        seed = next;
    }
    Triangles out;
    std::set<std::array<unsigned, 3>> seen;
    for (size_t t = 0; t < triangles.size(); t += 3) {
        std::array<unsigned, 3> corners = {nearest[triangles[t]], nearest[triangles[t + 1]],
                                           nearest[triangles[t + 2]]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        std::array<unsigned, 3> key = corners;
        std::sort(key.begin(), key.end());
        if (seen.insert(key).second) out.insert(out.end(), corners.begin(), corners.end());
    }
    return out;
}

// How far the furthest vertex of `all` is from those of `few`.
double furthestFrom(const Triangles& few, const Triangles& all, const std::vector<glm::dvec3>& positions) {
    const std::set<unsigned> near(few.begin(), few.end());
    double out = 0;
    for (const unsigned v : all) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const unsigned other : near)
            nearest = std::min(nearest, glm::distance(positions[v], positions[other]));
        out = std::max(out, nearest);
    }
    return out;
}

double areaOf(const Triangles& triangles, const std::vector<glm::dvec3>& positions) {
    double out = 0;
    for (size_t t = 0; t < triangles.size(); t += 3) {
        const glm::dvec3& a = positions[triangles[t]];
        out +=
            0.5 * glm::length(glm::cross(positions[triangles[t + 1]] - a, positions[triangles[t + 2]] - a));
    }
    return out;
}

// Triangles that share an edge with another pass it in opposite directions, as far as there is a way.
void faceAlike(std::vector<glm::ivec3>& triangles) {
    std::map<std::pair<int, int>, std::vector<size_t>> edges;
    for (size_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i)
            edges[std::minmax({triangles[t][i], triangles[t][(i + 1) % 3]})].push_back(t);
    const auto passes = [&](size_t t, int a, int b) {
        for (int i = 0; i < 3; ++i)
            if (triangles[t][i] == a && triangles[t][(i + 1) % 3] == b) return true;
        return false;
    };
    std::vector<bool> settled(triangles.size());
    for (size_t start = 0; start < triangles.size(); ++start) {
        if (settled[start]) continue;
        settled[start] = true;
        std::vector<size_t> front{start};
        while (!front.empty()) {
            const size_t t = front.back();
            front.pop_back();
            const glm::ivec3 corners = triangles[t];
            for (int i = 0; i < 3; ++i) {
                const int a = corners[i], b = corners[(i + 1) % 3];
                const std::vector<size_t>& sides = edges[std::minmax({a, b})];
                if (sides.size() != 2) continue;
                const size_t other = sides[0] == t ? sides[1] : sides[0];
                if (settled[other]) continue;
                settled[other] = true;
                if (passes(other, a, b)) std::swap(triangles[other].y, triangles[other].z);
                front.push_back(other);
            }
        }
    }
}

}  // namespace

double flatness(const std::vector<glm::dvec3>& points) {
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : points)
        middle += p / double(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const glm::dvec3& p : points) {
        const Eigen::Vector3d d(p.x - middle.x, p.y - middle.y, p.z - middle.z);
        spread += d * d.transpose();
    }
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
    return values(2) > 0 ? std::sqrt(std::max(0.0, values(0)) / values(2)) : 0;
}

void fold(CoarseMesh& coarse, double height) {
    glm::dvec3 normal(0);
    std::vector<std::pair<int, int>> edges;
    for (const glm::ivec3& t : coarse.triangles) {
        const glm::dvec3& a = coarse.positions[size_t(t.x)];
        const glm::dvec3 area =
            glm::cross(coarse.positions[size_t(t.y)] - a, coarse.positions[size_t(t.z)] - a);
        normal += glm::dot(area, normal) < 0 ? -area : area;
        for (int i = 0; i < 3; ++i)
            edges.emplace_back(t[i], t[(i + 1) % 3]);
    }
    if (!(glm::length(normal) > 0)) return;  // all in one line: there is no side to fold to
    normal = glm::normalize(normal);
    // as many edges as can be from up to down: greedily, one vertex after another
    std::vector<int> side(coarse.positions.size(), 0);
    for (int round = 0; round < 8; ++round)
        for (size_t v = 0; v < side.size(); ++v) {
            int sum = 0;
            for (const auto& edge : edges) {
                if (size_t(edge.first) == v) sum += side[size_t(edge.second)];
                if (size_t(edge.second) == v) sum += side[size_t(edge.first)];
            }
            side[v] = sum > 0 ? -1 : 1;
        }
    for (size_t v = 0; v < side.size(); ++v)
        coarse.positions[v] += 0.5 * height * side[v] * normal;
}

void mapToCoarse(const Mesh& mesh, CoarseMesh& coarse) {
    const std::vector<glm::dvec3>& places = mesh.weldedPositions;
    std::vector<std::vector<std::pair<int, double>>> ways(places.size());
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const int a = mesh.weld[size_t(t[i])], b = mesh.weld[size_t(t[(i + 1) % 3])];
            const double length = glm::distance(places[size_t(a)], places[size_t(b)]);
            ways[size_t(a)].emplace_back(b, length);
            ways[size_t(b)].emplace_back(a, length);
        }
    coarse.map.assign(places.size(), -1);
    coarse.source.clear();
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    std::vector<double> distance(places.size(), std::numeric_limits<double>::infinity());
    for (size_t c = 0; c < coarse.positions.size(); ++c) {
        size_t near = 0;
        for (size_t v = 0; v < places.size(); ++v)
            if (glm::distance(places[v], coarse.positions[c]) <
                glm::distance(places[near], coarse.positions[c]))
                near = v;
        coarse.source.push_back(int(near));
        const double d = glm::distance(places[near], coarse.positions[c]);
        if (d >= distance[near]) continue;
        distance[near] = d;
        coarse.map[near] = int(c);
        front.emplace(d, int(near));
    }
    while (!front.empty()) {
        const auto [d, v] = front.top();
        front.pop();
        if (d > distance[size_t(v)]) continue;
        for (const auto& [to, length] : ways[size_t(v)]) {
            if (d + length >= distance[size_t(to)]) continue;
            distance[size_t(to)] = d + length;
            coarse.map[size_t(to)] = coarse.map[size_t(v)];
            front.emplace(d + length, to);
        }
    }
    // parts of the mesh of which no vertex was kept
    for (size_t v = 0; v < places.size(); ++v) {
        if (coarse.map[v] >= 0) continue;
        double best = std::numeric_limits<double>::infinity();
        for (size_t c = 0; c < coarse.positions.size(); ++c) {
            const double d = glm::distance(places[v], coarse.positions[c]);
            if (d < best) best = d, coarse.map[v] = int(c);
        }
    }
}

CoarseMesh simplify(const Mesh& mesh, int vertices) {
    const Triangles all = weldedTriangles(mesh);
    const auto most = size_t(vertices);
    Triangles few = all;
    if (verticesOf(all) > most) {
        std::vector<glm::vec3> positions;  // about the middle, whatever the distance from the origin
        for (const glm::dvec3& p : mesh.weldedPositions)
            positions.emplace_back(p - 0.5 * (mesh.low + mesh.high));
        if (flatness(mesh.weldedPositions) > flat) few = collapse(all, positions, most);
        const size_t left = verticesOf(few);
        // A straight piece keeps its ends alone.
        const double furthest = std::min(0.25 * glm::distance(mesh.low, mesh.high),
                                         1.5 * std::sqrt(areaOf(all, mesh.weldedPositions) / double(most)));
        const auto reach = [&](const Triangles& triangles) {
            return furthestFrom(triangles, all, mesh.weldedPositions);
        };
        const bool unsound = left > most || left < 4 || 10 * left < 6 * most;
        if (unsound || reach(few) > furthest) {
            Triangles gathered = gather(all, mesh.weldedPositions, most);
            if (unsound || (verticesOf(gathered) >= 4 && reach(gathered) < reach(few)))
                few = std::move(gathered);
        }
    }
    CoarseMesh out;
    std::vector<int> numbers(mesh.weldedPositions.size(), -1);
    for (size_t t = 0; t < few.size(); t += 3) {
        glm::ivec3 triangle;
        for (int i = 0; i < 3; ++i) {
            int& number = numbers[few[t + size_t(i)]];
            if (number < 0) {
                number = int(out.positions.size());
                out.positions.push_back(mesh.weldedPositions[few[t + size_t(i)]]);
            }
            triangle[i] = number;
        }
        out.triangles.push_back(triangle);
    }
    faceAlike(out.triangles);
    return out;
}

Inside::Inside(const Mesh& mesh) {
    constexpr double wanted = 200'000;  // samples
    constexpr double finest = 1.0 / 250;
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const glm::dvec3 box = glm::max(extent, glm::dvec3(finest * longest));
    grid_.cell = std::max(std::cbrt(box.x * box.y * box.z / wanted), finest * longest);
    grid_.size = glm::ivec3(glm::ceil(box / grid_.cell)) + 1;
    grid_.low = 0.5 * (mesh.low + mesh.high) - 0.5 * grid_.cell * glm::dvec3(grid_.size - 1);
    winding_ = windingNumbers(mesh, grid_, allThreads());
    for (int z = 0; z < grid_.size.z; ++z)
        for (int y = 0; y < grid_.size.y; ++y)
            for (int x = 0; x < grid_.size.x; ++x)
                if (winding_[grid_.index(x, y, z)] != 0) samples_.push_back(grid_.place(x, y, z));
}

bool Inside::contains(const glm::dvec3& point) const {
    const glm::ivec3 cell(glm::round((point - grid_.low) / grid_.cell));
    for (int axis = 0; axis < 3; ++axis)
        if (cell[axis] < 0 || cell[axis] >= grid_.size[axis]) return false;
    return winding_[grid_.index(cell.x, cell.y, cell.z)] != 0;
}

double Inside::share(const glm::dvec3& a, const glm::dvec3& b) const {
    constexpr int points = 9;
    int count = 0;
    for (int i = 1; i <= points; ++i)
        count += contains(glm::mix(a, b, double(i) / (points + 1))) ? 1 : 0;
    return double(count) / points;
}

}  // namespace shoal
