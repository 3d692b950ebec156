#include "geometry/sample_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace shoal {

namespace {

// A triangle in units of cells from the first sample, with its welded vertices.
struct ScanCorners {
    std::array<glm::dvec3, 3> points;
    std::array<int, 3> vertex;
};

// Twice the area of (a, b, p), above 0 when anticlockwise.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

// Crossings of the lines along one axis.
class Scan {
  public:
    Scan(const std::vector<ScanCorners>& triangles, const SampleGrid& grid, int axis)
        : triangles_(triangles),
          grid_(grid),
          axis_(axis),
          u_((axis + 1) % 3),
          v_((axis + 2) % 3),
          counts_(grid.count(), 0) {}

    // Lines of the rows from <= v < to.
    void rows(int from, int to) {
        for (const ScanCorners& t : triangles_)
            cross(t, from, to);
        sumUp(from, to);
    }

    std::vector<int16_t> take() { return std::move(counts_); }

  private:
    void cross(const ScanCorners& t, int from, int to) {
        glm::dvec2 p[3], low(1e300), high(-1e300);
        for (int i = 0; i < 3; ++i) {
            p[i] = {t.points[size_t(i)][u_], t.points[size_t(i)][v_]};
            low = glm::min(low, p[i]);
            high = glm::max(high, p[i]);
        }
        const auto first = [](double x, int least) { return std::max(least, int(std::max(x, -1.0))); };
        const auto last = [](double x, int most) { return std::min(most, int(std::ceil(std::min(x, 1e9)))); };
        for (int v = first(low.y, from); v <= last(high.y, to - 1); ++v)
            for (int u = first(low.x, 0); u <= last(high.x, grid_.size[u_] - 1); ++u)
                crossLine(t, p, u, v);
    }

    void crossLine(const ScanCorners& t, const glm::dvec2 (&p)[3], int u, int v) {
        double areas[3];  // opposite each corner
        int sides = 0;
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            // from the lower vertex to the higher one: an edge's two triangles compute the same bits
            const bool turned = t.vertex[size_t(a)] > t.vertex[size_t(b)];
            const glm::dvec2 &from = turned ? p[b] : p[a], &to = turned ? p[a] : p[b];
            const double area = turn(from, to, glm::dvec2(u, v));
            // at 0 the line is moved by (d, d^2), d without end small
            const double side = area != 0 ? area : from.y != to.y ? from.y - to.y : to.x - from.x;
            sides += (side > 0) != turned ? 1 : -1;
            areas[i] = std::abs(area);
            if (sides != i + 1 && sides != -i - 1) return;
        }
        const double sum = areas[0] + areas[1] + areas[2];
        double depth = 0;
        for (int i = 0; i < 3; ++i)
            depth += t.points[size_t(i)][axis_] * (sum > 0 ? areas[i] / sum : 1 / 3.0);
        // anticlockwise: its normal points along the line, which leaves the volume here
        const double next = std::ceil(depth);
        if (next >= grid_.size[axis_]) return;
        int16_t& count = counts_[indexOf(int(std::max(next, 0.0)), u, v)];
        count = int16_t(count + (sides > 0 ? -1 : 1));
    }

    size_t indexOf(int along, int u, int v) const {
        glm::ivec3 sample;
        sample[axis_] = along, sample[u_] = u, sample[v_] = v;
        return grid_.index(sample.x, sample.y, sample.z);
    }

    void sumUp(int from, int to) {
        for (int v = from; v < to; ++v)
            for (int u = 0; u < grid_.size[u_]; ++u)
                for (int i = 1; i < grid_.size[axis_]; ++i)
                    counts_[indexOf(i, u, v)] =
                        int16_t(counts_[indexOf(i, u, v)] + counts_[indexOf(i - 1, u, v)]);
    }

    const std::vector<ScanCorners>& triangles_;
    const SampleGrid& grid_;
    int axis_, u_, v_;
    std::vector<int16_t> counts_;
};

std::vector<int16_t> scan(const std::vector<ScanCorners>& triangles, const SampleGrid& grid, int axis,
                          int threads) {
    Scan out(triangles, grid, axis);
    const int rows = grid.size[(axis + 2) % 3], pieces = std::min(rows, 4 * threads);
    parallel(pieces, threads,
             [&](int piece) { out.rows(rows * piece / pieces, rows * (piece + 1) / pieces); });
    return out.take();
}

}  // namespace

std::vector<int16_t> windingNumbers(const Mesh& mesh, const SampleGrid& grid, int threads) {
    std::vector<ScanCorners> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const glm::ivec3& t : mesh.triangles) {
        ScanCorners corners;
        for (int i = 0; i < 3; ++i) {
            corners.vertex[size_t(i)] = mesh.weld[size_t(t[i])];
            corners.points[size_t(i)] =
                (mesh.weldedPositions[size_t(corners.vertex[size_t(i)])] - grid.low) / grid.cell;
        }
        const auto& v = corners.vertex;
        if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) triangles.push_back(corners);
    }
    std::vector<int16_t> x = scan(triangles, grid, 0, threads);
    const std::vector<int16_t> y = scan(triangles, grid, 1, threads), z = scan(triangles, grid, 2, threads);
    for (size_t i = 0; i < x.size(); ++i)
        x[i] = std::max(std::min(x[i], y[i]), std::min(std::max(x[i], y[i]), z[i]));
    return x;
}

// ---- Distances inwards

namespace {

// The depth at a sample from the least depths beside it along each axis (Godunov's upwind difference).
double depthFrom(double a, double b, double c, double cell) {
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    double out = a + cell;
    if (out <= b) return out;
    out = (a + b + std::sqrt(std::max(2 * cell * cell - (a - b) * (a - b), 0.0))) / 2;
    if (out <= c) return out;
    const double sum = a + b + c, squares = a * a + b * b + c * c;
    return (sum + std::sqrt(std::max(sum * sum - 3 * (squares - cell * cell), 0.0))) / 3;
}

}  // namespace

void continueInwards(std::vector<float>& distances, const std::vector<char>& marked, const SampleGrid& grid) {
    constexpr float unknown = -std::numeric_limits<float>::max();
    for (size_t i = 0; i < distances.size(); ++i)
        if (marked[i]) distances[i] = unknown;
    const auto depth = [&](int x, int y, int z) {
        const bool within =
            x >= 0 && y >= 0 && z >= 0 && x < grid.size.x && y < grid.size.y && z < grid.size.z;
        return within ? -double(distances[grid.index(x, y, z)]) : std::numeric_limits<double>::max();
    };
    const auto update = [&](int x, int y, int z) {
        float& d = distances[grid.index(x, y, z)];
        const double found = depthFrom(std::min(depth(x - 1, y, z), depth(x + 1, y, z)),
                                       std::min(depth(x, y - 1, z), depth(x, y + 1, z)),
                                       std::min(depth(x, y, z - 1), depth(x, y, z + 1)), grid.cell);
        d = std::max(d, -float(std::min(found, 1e30)));
    };
    for (int sweep = 0; sweep < 16; ++sweep) {  // eight directions, twice
        for (int k = 0; k < grid.size.z; ++k)
            for (int j = 0; j < grid.size.y; ++j)
                for (int i = 0; i < grid.size.x; ++i) {
                    const int x = sweep & 1 ? grid.size.x - 1 - i : i,
                              y = sweep & 2 ? grid.size.y - 1 - j : j;
                    const int z = sweep & 4 ? grid.size.z - 1 - k : k;
                    if (marked[grid.index(x, y, z)]) update(x, y, z);
                }
    }
}

}  // namespace shoal
