// Rows across a flat sheet, each from one border to the other, so that it bends along them as a beam does.
#include <algorithm>
#include <cmath>

#include "author/mass_spread.h"

namespace shoal {

namespace {

// The line across a sheet at a place along its axis: where it enters and leaves, and how much of it is
// covered.
struct Chord {
    double low = 1e300, high = -1e300, covered = 0;
    double width() const { return std::max(0.0, high - low); }
};

struct Plane {
    glm::dvec3 axis, side, thin;
    double height;      // m, along thin
    double start, end;  // m, along the axis

    Chord chord(const Mesh& mesh, double place) const {
        Chord out;
        for (const glm::ivec3& t : mesh.triangles) {
            double low = 1e300, high = -1e300;
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 a = mesh.positions[size_t(t[i])], b = mesh.positions[size_t(t[(i + 1) % 3])];
                const double from = glm::dot(a, axis) - place, to = glm::dot(b, axis) - place;
                if ((from > 0) == (to > 0)) continue;
                const double where = glm::dot(a + (b - a) * (from / (from - to)), side);
                low = std::min(low, where), high = std::max(high, where);
            }
            if (low > high) continue;
            out.covered += high - low;
            out.low = std::min(out.low, low), out.high = std::max(out.high, high);
        }
        return out;
    }
    glm::dvec3 place(double along, double across) const {
        return along * axis + across * side + height * thin;
    }
};

struct Grid {
    int rows = 0, columns = 0;
};

// Of at most so many vertices, nearly all of them, with cells that are nearly squares; 4 rows or more.
Grid gridFor(double length, double width, int vertices) {
    Grid best;
    double least = 1e300;
    for (int columns = 2; 4 * columns <= vertices; ++columns) {
        const int rows = vertices / columns;
        const double shape = std::abs(std::log(length / (rows - 1) / (width / (columns - 1)))) +
                             2 * double(vertices - rows * columns) / vertices;
        if (shape < least) least = shape, best = {rows, columns};
    }
    return best;
}

class Rows {
  public:
    explicit Rows(bool turned) : turned_(turned) {}

    void add(const std::vector<glm::dvec3>& places) {
        const int first = int(out_.positions.size()), count = int(places.size());
        out_.positions.insert(out_.positions.end(), places.begin(), places.end());
        if (count_ == 1 || count == 1) {
            for (int i = 0; i + 1 < std::max(count, count_); ++i) {
                if (count_ == 1 && count > 1) triangle(first_, first + i + 1, first + i);
                if (count == 1 && count_ > 1) triangle(first_ + i, first_ + i + 1, first);
            }
        } else {
            // diagonals in turn, so that it does not twist as it bends
            for (int i = 0; i + 1 < count && count_ > 0; ++i) {
                const int a = first_ + i, b = a + 1, c = first + i, d = c + 1;
                const bool rising = (i + row_) % 2 == 0;
                triangle(a, b, rising ? d : c);
                triangle(rising ? a : b, d, c);
            }
        }
        first_ = first, count_ = count, ++row_;
    }
    CoarseMesh take() { return std::move(out_); }

  private:
    void triangle(int a, int b, int c) {
        out_.triangles.push_back(turned_ ? glm::ivec3(a, c, b) : glm::ivec3(a, b, c));
    }

    bool turned_;
    CoarseMesh out_;
    int first_ = 0, count_ = 0, row_ = 0;
};

}  // namespace

std::optional<CoarseMesh> rowsOf(const Mesh& mesh, int vertices) {
    constexpr double inset = 0.02;    // of a cell: at the very end a section may vanish
    constexpr double pointed = 0.25;  // of the mean width: a narrower end is a point
    constexpr double whole = 0.95;    // of a section: without gaps
    const MassSpread found = spreadOfSheet(mesh);
    Plane plane{found.axis, glm::cross(found.thin, found.axis), found.thin, 0, 1e300, -1e300};
    glm::dvec3 normal(0);
    double area = 0;
    for (const glm::dvec3& p : mesh.weldedPositions) {
        plane.start = std::min(plane.start, glm::dot(p, plane.axis));
        plane.end = std::max(plane.end, glm::dot(p, plane.axis));
        plane.height += glm::dot(p, plane.thin) / double(mesh.weldedPositions.size());
    }
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[size_t(t.x)];
        const glm::dvec3 twice = glm::cross(mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a);
        area += 0.5 * glm::length(twice);
        normal += twice;
    }
    const double length = plane.end - plane.start, width = area / length;
    Grid grid = gridFor(length, width, vertices);
    if (grid.rows == 0) return {};
    const auto chordOf = [&](int row) {
        const double share = std::clamp(double(row), inset, grid.rows - 1 - inset) / (grid.rows - 1);
        return plane.chord(mesh, plane.start + share * length);
    };
    // A pointed end leaves vertices for another row.
    int ends = 0;
    for (const int row : {0, grid.rows - 1})
        if (chordOf(row).width() < pointed * width) ++ends;
    grid.rows = (vertices + ends * (grid.columns - 1)) / grid.columns;
    Rows out(glm::dot(normal, plane.thin) > 0);
    for (int row = 0; row < grid.rows; ++row) {
        const Chord chord = chordOf(row);
        if (!(chord.covered > whole * chord.width()) || chord.covered > chord.width() / whole) return {};
        const double along = plane.start + row * length / (grid.rows - 1);
        std::vector<glm::dvec3> places;
        const bool end = row == 0 || row == grid.rows - 1;
        if (end && chord.width() < pointed * width)
            places.push_back(plane.place(along, 0.5 * (chord.low + chord.high)));
        else
            for (int i = 0; i < grid.columns; ++i)
                places.push_back(
                    plane.place(along, std::lerp(chord.low, chord.high, double(i) / (grid.columns - 1))));
        out.add(places);
    }
    return out.take();
}

}  // namespace shoal
