// A cage: the cells of a body-centred cubic lattice through which a surface passes, or which it encloses.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "author/coarse.h"
#include "core/error.h"

namespace shoal {

namespace {

// One tetrahedron: between the centre of a cube and that of the next along an axis, one of the four about
// their common face.
struct Key {
    glm::ivec3 cube{0};
    int axis = 0, quarter = 0;
    auto operator<=>(const Key& o) const {
        return std::tie(cube.x, cube.y, cube.z, axis, quarter) <=>
               std::tie(o.cube.x, o.cube.y, o.cube.z, o.axis, o.quarter);
    }
    bool operator==(const Key& o) const { return (*this <=> o) == std::strong_ordering::equal; }
};

// Corners in halves of the spacing: those of cubes are even, their centres odd.
std::array<glm::ivec3, 4> cornersOf(const Key& key) {
    constexpr int turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    std::array<glm::ivec3, 4> out;
    out[0] = out[1] = out[2] = out[3] = 2 * key.cube + 1;
    out[1][key.axis] += 2;
    for (int i = 0; i < 2; ++i) {
        glm::ivec3& corner = out[size_t(2 + i)];
        const int* sides = turn[(key.quarter + i) % 4];
        corner[key.axis] += 1;
        corner[(key.axis + 1) % 3] += sides[0];
        corner[(key.axis + 2) % 3] += sides[1];
    }
    return out;
}

// The cell that holds a point, whose unit is the spacing.
Key cellAt(const glm::dvec3& point) {
    Key out;
    const glm::dvec3 cube = glm::floor(point), from = point - cube - 0.5;
    out.cube = glm::ivec3(cube);
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(from[axis]) > std::abs(from[out.axis])) out.axis = axis;
    if (from[out.axis] < 0) out.cube[out.axis] -= 1;
    const double u = from[(out.axis + 1) % 3], v = from[(out.axis + 2) % 3];
    out.quarter = v >= std::abs(u) ? 0 : u <= -std::abs(v) ? 1 : v <= -std::abs(u) ? 2 : 3;
    return out;
}

// Places on the surface no further than `step` from one another, all vertices among them.
std::vector<glm::dvec3> placesOn(const Mesh& mesh, double step) {
    std::vector<glm::dvec3> out = mesh.weldedPositions;
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[size_t(t.x)], ab = mesh.positions[size_t(t.y)] - a,
                         ac = mesh.positions[size_t(t.z)] - a;
        const double longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
        const int n = int(std::clamp(std::ceil(longest / step), 1.0, 400.0));
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j)
                out.push_back(a + (double(i) / n) * ab + (double(j) / n) * ac);
    }
    return out;
}

struct Lattices {
    double spacing = 1;
    glm::dvec3 origin{0};
    glm::dvec3 scaled(const glm::dvec3& place) const { return (place - origin) / spacing; }
};

// The cells of one part each, which hang together by faces.
std::vector<int> partsOf(const std::vector<Key>& cells) {
    std::vector<int> parent(cells.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int i) {
        while (parent[size_t(i)] != i)
            i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
        return i;
    };
    std::map<std::array<int, 9>, int> faces;
    for (size_t c = 0; c < cells.size(); ++c) {
        const std::array<glm::ivec3, 4> corners = cornersOf(cells[c]);
        for (size_t apex = 0; apex < 4; ++apex) {
            std::array<std::array<int, 3>, 3> face;
            for (size_t i = 0; i < 3; ++i) {
                const glm::ivec3& corner = corners[(apex + 1 + i) % 4];
                face[i] = {corner.x, corner.y, corner.z};
            }
            std::sort(face.begin(), face.end());
            std::array<int, 9> key;
            for (size_t i = 0; i < 9; ++i)
                key[i] = face[i / 3][i % 3];
            const auto [entry, isNew] = faces.try_emplace(key, int(c));
            if (!isNew) parent[size_t(root(int(c)))] = root(entry->second);
        }
    }
    for (size_t c = 0; c < cells.size(); ++c)
        parent[c] = root(int(c));
    return parent;
}

// Adds every cell about the corners at which parts meet: hinges would bend without resistance.
bool joinAtCorners(std::set<Key>& cells) {
    const std::vector<Key> list(cells.begin(), cells.end());
    const std::vector<int> parts = partsOf(list);
    if (std::all_of(parts.begin(), parts.end(), [&](int part) { return part == parts[0]; })) return false;
    std::map<std::array<int, 3>, std::set<int>> at;
    for (size_t c = 0; c < list.size(); ++c)
        for (const glm::ivec3& corner : cornersOf(list[c]))
            at[{corner.x, corner.y, corner.z}].insert(parts[c]);
    const size_t before = cells.size();
    for (const auto& [corner, here] : at) {
        if (here.size() < 2) continue;
        const glm::dvec3 place = 0.5 * glm::dvec3(corner[0], corner[1], corner[2]);
        // The cells about a place have points this near to it in every direction.
        for (int i = 0; i < 7 * 7 * 7; ++i) {
            const glm::dvec3 way = glm::dvec3(i % 7, i / 7 % 7, i / 49) - 3.0 + glm::dvec3(0.01, 0.02, 0.03);
            cells.insert(cellAt(place + 0.05 * way));
        }
    }
    return cells.size() > before;
}

size_t cornerCount(const std::set<Key>& cells) {
    std::set<std::array<int, 3>> all;
    for (const Key& key : cells)
        for (const glm::ivec3& corner : cornersOf(key))
            all.insert({corner.x, corner.y, corner.z});
    return all.size();
}

// In one part; empty: in several, or with more than so many vertices.
std::set<Key> cellsThrough(const std::vector<glm::dvec3>& places, const Lattices& lattice, size_t most) {
    std::set<Key> cells;
    for (const glm::dvec3& place : places)
        cells.insert(cellAt(lattice.scaled(place)));
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && cells.size() < 8 * most && joinAtCorners(cells); ++round) {
    }
    if (cornerCount(cells) > most) return {};
    const std::vector<int> parts = partsOf({cells.begin(), cells.end()});
    return std::all_of(parts.begin(), parts.end(), [&](int part) { return part == parts[0]; })
               ? cells
               : std::set<Key>();
}

// Draws the vertices in to the surface, by which things touch, as far as no cell loses much of its volume.
void drawIn(Lattice& lattice, const std::vector<glm::dvec3>& places) {
    std::vector<glm::dvec3>& vertices = lattice.surface.positions;
    const auto volume = [&](const std::array<int, 4>& cell) {
        const glm::dvec3& a = vertices[size_t(cell[0])];
        return glm::dot(vertices[size_t(cell[1])] - a,
                        glm::cross(vertices[size_t(cell[2])] - a, vertices[size_t(cell[3])] - a));
    };
    std::vector<std::vector<size_t>> cellsOf(vertices.size());
    std::vector<double> whole;
    for (size_t c = 0; c < lattice.cells.size(); ++c) {
        whole.push_back(volume(lattice.cells[c]));
        for (const int v : lattice.cells[c])
            cellsOf[size_t(v)].push_back(c);
    }
    constexpr int rounds = 2;
    constexpr double leastVolume = 0.3;
    for (int round = 0; round < rounds; ++round)
        for (size_t v = 0; v < vertices.size(); ++v) {
            double nearest = 1e300;
            glm::dvec3 to(0);
            for (const glm::dvec3& place : places) {
                const double distance = glm::distance(place, vertices[v]);
                if (distance < nearest) nearest = distance, to = place;
            }
            const glm::dvec3 from = vertices[v];
            for (double way = 1; way > 0.05; way *= 0.7) {
                vertices[v] = glm::mix(from, to, way);
                if (std::all_of(cellsOf[v].begin(), cellsOf[v].end(),
                                [&](size_t c) { return volume(lattice.cells[c]) / whole[c] > leastVolume; }))
                    break;
                vertices[v] = from;
            }
        }
}

Lattice assembled(const std::set<Key>& cells, const Lattices& at) {
    std::map<std::array<int, 3>, int> numbers;
    std::vector<glm::dvec3> places;
    std::vector<std::array<int, 4>> out;
    for (const Key& key : cells) {
        std::array<int, 4> cell;
        const std::array<glm::ivec3, 4> corners = cornersOf(key);
        for (size_t i = 0; i < 4; ++i) {
            const glm::ivec3& corner = corners[i];
            const auto [entry, isNew] =
                numbers.try_emplace({corner.x, corner.y, corner.z}, int(places.size()));
            if (isNew) places.push_back(at.origin + 0.5 * at.spacing * glm::dvec3(corner));
            cell[i] = entry->second;
        }
        out.push_back(cell);
    }
    return latticeOf(std::move(places), std::move(out));
}

}  // namespace

Lattice cageAround(const Mesh& mesh, const Inside* inside, int vertices) {
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    std::vector<glm::dvec3> surface = placesOn(mesh, longest / 150), all = surface;
    if (inside) {
        const std::vector<glm::dvec3>& samples = inside->samples();
        const size_t every = samples.size() / 20000 + 1;
        for (size_t i = 0; i < samples.size(); i += every)
            all.push_back(samples[i]);
    }
    std::set<Key> best;
    Lattices bestAt;
    int worse = 0;  // spacings in a row that give nothing
    for (double spacing = longest; spacing > longest / 30 && worse < 5; spacing *= 0.92) {
        ++worse;
        for (const double offset : {0.0, 0.3, 0.6}) {
            const Lattices at{spacing,
                              0.5 * (mesh.low + mesh.high) + spacing * glm::dvec3(offset, 0.7 * offset, 0.4)};
            std::set<Key> cells = cellsThrough(all, at, size_t(vertices));
            if (cells.empty()) continue;
            worse = 0;
            if (bestAt.spacing > spacing || best.empty() || cornerCount(cells) > cornerCount(best)) {
                best = std::move(cells);
                bestAt = at;
            }
        }
        if (best.empty()) worse = 0;  // too coarse still, or in parts
    }
    if (best.empty())
        throw Error("no cage of at most ", vertices,
                    " vertices holds all parts of this mesh: take more vertices");
    Lattice out = assembled(best, bestAt);
    drawIn(out, surface);
    return out;
}

}  // namespace shoal
