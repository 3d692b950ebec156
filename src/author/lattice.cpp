#include "author/coarse.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/error.h"

namespace shoal {

namespace {

using Cell = std::array<int, 4>;

// Points of a tetrahedron, all inside it, for the share of it that a volume fills.
std::vector<glm::dvec4> probes() {
    std::vector<glm::dvec4> out;
    constexpr int n = 4;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            for (int k = 0; i + j + k <= n; ++k)
                out.push_back((glm::dvec4(i, j, k, n - i - j - k) + 0.25) / (n + 1.0));
    return out;
}

// The lattice of one spacing and offset, and what of it is kept.
class Builder {
  public:
    Builder(const Mesh& mesh, const Inside& inside, double spacing, const glm::dvec3& offset)
        : inside_(inside), spacing_(spacing) {
        const glm::dvec3 middle = 0.5 * (mesh.low + mesh.high), half = 0.5 * (mesh.high - mesh.low);
        count_ = glm::ivec3(glm::ceil(half / spacing)) + 1;
        origin_ = middle + spacing * offset;
    }

    // Cells of which the volume fills a quarter or more; `most` vertices, else nothing.
    std::vector<Cell> keep(size_t most) {
        static const std::vector<glm::dvec4> points = probes();
        std::vector<Cell> kept;
        for (int axis = 0; axis < 3; ++axis)
            forAll([&](const glm::ivec3& centre) {
                for (const Cell& cell : around(centre, axis)) {
                    if (fill(cell, points) < 0.25) continue;
                    kept.push_back(cell);
                }
            });
        kept = largestPart(kept);
        return used(kept) <= most ? kept : std::vector<Cell>();
    }
    const glm::dvec3& place(int vertex) const { return places_[size_t(vertex)]; }

  private:
    template <typename Visit>
    void forAll(const Visit& visit) {
        glm::ivec3 c;
        for (c.z = -count_.z; c.z <= count_.z; ++c.z)
            for (c.y = -count_.y; c.y <= count_.y; ++c.y)
                for (c.x = -count_.x; c.x <= count_.x; ++c.x)
                    visit(c);
    }

    // In halves of the spacing: corners are even, centres odd.
    int vertex(const glm::ivec3& halves) {
        const auto [entry, isNew] = numbers_.try_emplace({halves.x, halves.y, halves.z}, int(places_.size()));
        if (isNew) places_.push_back(origin_ + 0.5 * spacing_ * glm::dvec3(halves));
        return entry->second;
    }

    // The four tetrahedra between the centre of a cube and that of the next along an axis.
    std::array<Cell, 4> around(const glm::ivec3& cube, int axis) {
        std::array<Cell, 4> out;
        for (int quarter = 0; quarter < 4; ++quarter) {
            const std::array<glm::ivec3, 4> corners = LatticeCell{cube, axis, quarter}.corners();
            for (size_t i = 0; i < 4; ++i)
                out[size_t(quarter)][i] = vertex(corners[i]);
        }
        return out;
    }

    double fill(const Cell& cell, const std::vector<glm::dvec4>& points) const {
        int count = 0;
        for (const glm::dvec4& p : points) {
            glm::dvec3 point(0);
            for (int i = 0; i < 4; ++i)
                point += p[i] * place(cell[size_t(i)]);
            count += inside_.contains(point) ? 1 : 0;
        }
        return double(count) / double(points.size());
    }

    static size_t used(const std::vector<Cell>& cells) {
        std::vector<int> all;
        for (const Cell& cell : cells)
            all.insert(all.end(), cell.begin(), cell.end());
        std::sort(all.begin(), all.end());
        return size_t(std::unique(all.begin(), all.end()) - all.begin());
    }

    static std::vector<Cell> largestPart(const std::vector<Cell>& cells) {
        const std::vector<size_t> parts = partsOf(cells);
        std::map<size_t, size_t> sizes;
        for (size_t c = 0; c < cells.size(); ++c)
            ++sizes[parts[c]];
        size_t best = 0;
        for (const auto& [part, size] : sizes)
            if (!sizes.contains(best) || size > sizes[best]) best = part;
        std::vector<Cell> out;
        for (size_t c = 0; c < cells.size(); ++c)
            if (parts[c] == best) out.push_back(cells[c]);
        return out;
    }

    const Inside& inside_;
    double spacing_;
    glm::ivec3 count_{0};
    glm::dvec3 origin_{0};
    std::map<std::array<int, 3>, int> numbers_;
    std::vector<glm::dvec3> places_;
};

Lattice assemble(const std::vector<Cell>& kept, const Builder& builder) {
    std::vector<glm::dvec3> places;
    std::vector<Cell> cells;
    std::map<int, int> numbers;
    for (Cell cell : kept) {
        for (int& v : cell) {
            const auto [entry, isNew] = numbers.try_emplace(v, int(places.size()));
            if (isNew) places.push_back(builder.place(v));
            v = entry->second;
        }
        cells.push_back(cell);
    }
    return latticeOf(std::move(places), std::move(cells));
}

}  // namespace

std::array<glm::ivec3, 4> LatticeCell::corners() const {
    constexpr int turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    std::array<glm::ivec3, 4> out;
    out[0] = out[1] = out[2] = out[3] = 2 * cube + 1;
    out[1][axis] += 2;
    for (int i = 0; i < 2; ++i) {
        glm::ivec3& corner = out[size_t(2 + i)];
        const int* sides = turn[(quarter + i) % 4];
        corner[axis] += 1;
        corner[(axis + 1) % 3] += sides[0];
        corner[(axis + 2) % 3] += sides[1];
    }
    return out;
}

std::vector<size_t> partsOf(const std::vector<Cell>& cells) {
    std::vector<size_t> parent(cells.size());
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto root = [&](size_t i) {
        while (parent[i] != i)
            i = parent[i] = parent[parent[i]];
        return i;
    };
    std::map<std::array<int, 3>, size_t> faces;
    for (size_t c = 0; c < cells.size(); ++c)
        for (size_t out = 0; out < 4; ++out) {
            std::array<int, 3> face = {cells[c][(out + 1) % 4], cells[c][(out + 2) % 4],
                                       cells[c][(out + 3) % 4]};
            std::sort(face.begin(), face.end());
            const auto [entry, isNew] = faces.try_emplace(face, c);
            if (!isNew) parent[root(c)] = root(entry->second);
        }
    for (size_t c = 0; c < cells.size(); ++c)
        parent[c] = root(c);
    return parent;
}

Lattice latticeOf(std::vector<glm::dvec3> places, std::vector<Cell> cells) {
    Lattice out;
    out.surface.positions = std::move(places);
    out.cells = std::move(cells);
    std::map<std::array<int, 3>, glm::ivec3> faces;  // of one cell so far
    for (const Cell& cell : out.cells)
        for (size_t apex = 0; apex < 4; ++apex) {
            glm::ivec3 face(cell[(apex + 1) % 4], cell[(apex + 2) % 4], cell[(apex + 3) % 4]);
            const auto position = [&](int v) { return out.surface.positions[size_t(v)]; };
            const glm::dvec3 normal =
                glm::cross(position(face.y) - position(face.x), position(face.z) - position(face.x));
            if (glm::dot(normal, position(cell[apex]) - position(face.x)) > 0) std::swap(face.y, face.z);
            std::array<int, 3> key = {face.x, face.y, face.z};
            std::sort(key.begin(), key.end());
            if (!faces.try_emplace(key, face).second) faces.erase(key);
        }
    for (const auto& [key, face] : faces)
        out.surface.triangles.push_back(face);
    return out;
}

Lattice latticeIn(const Mesh& mesh, const Inside& inside, int vertices) {
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    Lattice best;
    int worse = 0;  // spacings in a row that hold nothing: finer ones have too many
    constexpr double finer = 0.92;
    for (double spacing = longest; spacing > longest / 40 && worse < 6; spacing *= finer) {
        ++worse;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 offset = 0.5 * glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            Builder builder(mesh, inside, spacing, offset);
            const std::vector<Cell> kept = builder.keep(size_t(vertices));
            if (kept.empty()) continue;
            worse = 0;
            Lattice lattice = assemble(kept, builder);
            if (lattice.surface.positions.size() > best.surface.positions.size()) best = std::move(lattice);
        }
        if (best.cells.empty()) worse = 0;  // too coarse still
    }
    if (best.cells.empty())
        throw Error("no lattice of at most ", vertices,
                    " vertices lies in this mesh, which is too thin: take more vertices, or springs of "
                    "the surface");
    return best;
}

}  // namespace shoal
