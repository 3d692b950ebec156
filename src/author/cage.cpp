// A cage: the cells of a body-centred cubic lattice through which a surface passes, or which it encloses.
#include <algorithm>
#include <map>
#include <set>

#include "author/coarse.h"
#include "core/error.h"

namespace shoal {

namespace {

// The cell that holds a point, whose unit is the spacing.
LatticeCell cellAt(const glm::dvec3& point) {
    LatticeCell out;
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

struct Numbered {
    std::vector<glm::ivec3> corners;  // in halves of the spacing
    std::vector<std::array<int, 4>> cells;

    bool whole() const {
        const std::vector<size_t> parts = partsOf(cells);
        return std::all_of(parts.begin(), parts.end(), [&](size_t part) { return part == parts[0]; });
    }
};

Numbered numbered(const std::set<LatticeCell>& cells) {
    Numbered out;
    std::map<std::array<int, 3>, int> numbers;
    for (const LatticeCell& cell : cells) {
        std::array<int, 4>& four = out.cells.emplace_back();
        const std::array<glm::ivec3, 4> corners = cell.corners();
        for (size_t i = 0; i < 4; ++i) {
            const glm::ivec3& corner = corners[i];
            const auto [entry, isNew] =
                numbers.try_emplace({corner.x, corner.y, corner.z}, int(out.corners.size()));
            if (isNew) out.corners.push_back(corner);
            four[i] = entry->second;
        }
    }
    return out;
}

// Adds every cell about the corners at which parts meet: hinges would bend without resistance.
void joinAtCorners(std::set<LatticeCell>& cells, const Numbered& numbered) {
    const std::vector<size_t> parts = partsOf(numbered.cells);
    std::vector<std::set<size_t>> partsAt(numbered.corners.size());
    for (size_t c = 0; c < parts.size(); ++c)
        for (const int corner : numbered.cells[c])
            partsAt[size_t(corner)].insert(parts[c]);
    for (size_t corner = 0; corner < partsAt.size(); ++corner) {
        if (partsAt[corner].size() < 2) continue;
        const glm::dvec3 place = 0.5 * glm::dvec3(numbered.corners[corner]);
        // The cells about a place have points this near to it in every direction.
        for (int i = 0; i < 7 * 7 * 7; ++i) {
            const glm::dvec3 way = glm::dvec3(i % 7, i / 7 % 7, i / 49) - 3.0 + glm::dvec3(0.01, 0.02, 0.03);
            cells.insert(cellAt(place + 0.05 * way));
        }
    }
}

// In one part; empty: in several, or with more than so many vertices.
Numbered cellsThrough(const std::vector<glm::dvec3>& places, const Lattices& lattice, size_t most) {
    std::set<LatticeCell> cells;
    for (const glm::dvec3& place : places)
        cells.insert(cellAt(lattice.scaled(place)));
    Numbered out = numbered(cells);
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && cells.size() < 8 * most && !out.whole(); ++round) {
        joinAtCorners(cells, out);
        out = numbered(cells);
    }
    return out.corners.size() <= most && out.whole() ? out : Numbered();
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
    Numbered best;
    Lattices bestAt;
    int worse = 0;  // spacings in a row that give nothing
    for (double spacing = longest; spacing > longest / 30 && worse < 5; spacing *= 0.92) {
        ++worse;
        for (const double offset : {0.0, 0.3, 0.6}) {
            const Lattices lattices{
                spacing, 0.5 * (mesh.low + mesh.high) + spacing * glm::dvec3(offset, 0.7 * offset, 0.4)};
            Numbered found = cellsThrough(all, lattices, size_t(vertices));
            if (found.cells.empty()) continue;
            worse = 0;
            if (bestAt.spacing > spacing || best.cells.empty() ||
                found.corners.size() > best.corners.size()) {
                best = std::move(found);
                bestAt = lattices;
            }
        }
        if (best.cells.empty()) worse = 0;  // too coarse still, or in parts
    }
    if (best.cells.empty())
        throw Error("no cage of at most ", vertices,
                    " vertices holds all parts of this mesh: take more vertices");
    std::vector<glm::dvec3> corners;
    for (const glm::ivec3& corner : best.corners)
        corners.push_back(bestAt.origin + 0.5 * bestAt.spacing * glm::dvec3(corner));
    Lattice out = latticeOf(std::move(corners), std::move(best.cells));
    drawIn(out, surface);
    return out;
}

}  // namespace shoal
