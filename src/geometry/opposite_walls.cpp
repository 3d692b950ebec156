#include "geometry/opposite_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace shoal {

namespace {

using Edge = std::pair<int, int>;  // welded vertices, the lower first

// Triangles that lie on others and face the opposite way: one on one, or two of a quad on two.
// The front is what comes first in the file.
struct Wall {
    std::vector<size_t> front, back;
    std::vector<Edge> border;
};

class Walls {
  public:
    explicit Walls(const Mesh& mesh)
        : mesh_(mesh), gone_(mesh.triangles.size(), 0), inWall_(mesh.triangles.size(), 0) {}

    std::vector<char> run() {
        pairTriangles();
        pairQuads();
        if (walls_.empty()) return std::move(gone_);
        join();
        settle();
        return std::move(gone_);
    }

  private:
    glm::ivec3 welded(size_t triangle) const {
        const glm::ivec3& t = mesh_.triangles[triangle];
        return {mesh_.weld[size_t(t.x)], mesh_.weld[size_t(t.y)], mesh_.weld[size_t(t.z)]};
    }
    const glm::dvec3& place(int vertex) const { return mesh_.weldedPositions[size_t(vertex)]; }
    glm::dvec3 normalOf(size_t triangle) const {
        const glm::ivec3 t = welded(triangle);
        return glm::cross(place(t.y) - place(t.x), place(t.z) - place(t.x));
    }
    static Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

    static bool degenerate(const glm::ivec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

    // Calls for each run of equal keys, which are sorted with what they are of.
    template <typename Key, typename Do>
    static void eachRun(std::vector<std::pair<Key, size_t>>& keyed, const Do& act) {
        std::sort(keyed.begin(), keyed.end());
        for (size_t from = 0, to = 0; from < keyed.size(); from = to) {
            while (to < keyed.size() && keyed[to].first == keyed[from].first)
                ++to;
            if (to - from > 1) act(from, to);
        }
    }

    // Of triangles on the same corners what does not cancel stays, once; of the rest the first of each side
    // may be a wall.
    void pairTriangles() {
        std::vector<std::pair<std::array<int, 3>, size_t>> keyed;
        keyed.reserve(mesh_.triangles.size());
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const glm::ivec3 t = welded(i);
            std::array<int, 3> key = {t.x, t.y, t.z};
            std::sort(key.begin(), key.end());
            keyed.emplace_back(key, i);
        }
        eachRun(keyed, [&](size_t from, size_t to) {
            std::vector<size_t> sides[2];
            for (size_t k = from; k < to; ++k) {
                const glm::ivec3 t = welded(keyed[k].second);
                const bool even = (t.x < t.y) + (t.y < t.z) + (t.z < t.x) == 2;  // a cycle upwards
                sides[even].push_back(keyed[k].second);
                gone_[keyed[k].second] = 1;
            }
            const bool cancel = sides[0].size() == sides[1].size() && !degenerate(welded(keyed[from].second));
            if (!cancel) {
                gone_[sides[sides[1].size() > sides[0].size()].front()] = 0;
                return;
            }
            const size_t first = std::min(sides[0].front(), sides[1].front());
            const glm::ivec3 t = welded(first);
            addWall({{first},
                     {std::max(sides[0].front(), sides[1].front())},
                     {edge(t.x, t.y), edge(t.y, t.z), edge(t.z, t.x)}});
        });
    }

    void addWall(Wall wall) {
        for (const auto* side : {&wall.front, &wall.back})
            for (const size_t t : *side)
                inWall_[t] = 1, gone_[t] = 1;
        walls_.push_back(std::move(wall));
    }

    // Two neighbours in a plane, by the corners of their quad.
    struct Quad {
        size_t a, b;
        Edge diagonal;
    };
    void pairQuads() {
        std::vector<std::pair<Edge, size_t>> sides;
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const glm::ivec3 t = welded(i);
            if (gone_[i] || degenerate(t)) continue;
            for (int k = 0; k < 3; ++k)
                sides.emplace_back(edge(t[k], t[(k + 1) % 3]), i);
        }
        std::vector<Quad> quads;
        eachRun(sides, [&](size_t from, size_t to) {
            constexpr size_t most = 16;  // triangles about an edge
            for (size_t a = from; a < to && to - from <= most; ++a)
                for (size_t b = a + 1; b < to; ++b)
                    if (inPlane(sides[a].second, sides[b].second))
                        quads.push_back({sides[a].second, sides[b].second, sides[a].first});
        });
        std::vector<std::pair<std::array<int, 4>, size_t>> keyed;
        for (size_t q = 0; q < quads.size(); ++q)
            keyed.emplace_back(cornersOf(quads[q]), q);
        eachRun(keyed, [&](size_t from, size_t to) {
            for (size_t k = from; k < to; ++k)
                for (size_t l = k + 1; l < to; ++l)
                    matchQuads(quads[keyed[k].second], quads[keyed[l].second]);
        });
    }

    // Whether two triangles of an edge face one way and lie in one plane, one on either side of the edge.
    bool inPlane(size_t a, size_t b) const {
        const glm::dvec3 na = normalOf(a), nb = normalOf(b);
        const double product = glm::length(na) * glm::length(nb);
        return glm::dot(na, nb) > (1 - 1e-9) * product && product > 0;
    }

    std::array<int, 4> cornersOf(const Quad& quad) const {
        std::array<int, 4> out = {quad.diagonal.first, quad.diagonal.second, 0, 0};
        size_t next = 2;
        for (const size_t triangle : {quad.a, quad.b})
            for (int k = 0; k < 3; ++k)
                if (const int v = welded(triangle)[k]; v != quad.diagonal.first && v != quad.diagonal.second)
                    out[next++] = v;
        std::sort(out.begin(), out.end());
        return out;
    }

    void matchQuads(const Quad& a, const Quad& b) {
        for (const size_t t : {a.a, a.b, b.a, b.b})
            if (inWall_[t]) return;
        if (a.diagonal == b.diagonal || glm::dot(normalOf(a.a), normalOf(b.a)) >= 0) return;
        const bool inOrder = std::min(a.a, a.b) < std::min(b.a, b.b);
        const Quad &front = inOrder ? a : b, &back = inOrder ? b : a;
        Wall wall{{front.a, front.b}, {back.a, back.b}, {}};
        for (const size_t triangle : wall.front)
            for (int k = 0; k < 3; ++k) {
                const glm::ivec3 t = welded(triangle);
                if (const Edge side = edge(t[k], t[(k + 1) % 3]); side != front.diagonal)
                    wall.border.push_back(side);
            }
        addWall(std::move(wall));
    }

    size_t root(size_t wall) {
        while (root_[wall] != wall)
            wall = root_[wall] = root_[root_[wall]];
        return wall;
    }

    // Walls that share an edge belong together.
    void join() {
        root_.resize(walls_.size());
        std::iota(root_.begin(), root_.end(), size_t(0));
        for (size_t w = 0; w < walls_.size(); ++w)
            for (const Edge& side : walls_[w].border) {
                const auto [first, fresh] = wallsAt_.try_emplace(side, w, 0);
                ++first->second.second;
                if (!fresh) root_[root(w)] = root(first->second.first);
            }
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            if (gone_[i]) continue;
            const glm::ivec3 t = welded(i);
            for (int k = 0; k < 3; ++k)
                if (const auto found = wallsAt_.find(edge(t[k], t[(k + 1) % 3])); found != wallsAt_.end())
                    heldAt_.insert(found->first);
        }
    }

    // A patch of walls is a sheet where an edge of one wall alone is free, or where nothing else touches it:
    // the front stays, of a closed one what faces outwards.
    void settle() {
        struct Patch {
            bool free = false, held = false;
            double volume = 0;  // m^3, of the front sides
        };
        std::map<size_t, Patch> patches;
        for (size_t w = 0; w < walls_.size(); ++w) {
            Patch& patch = patches[root(w)];
            for (const Edge& side : walls_[w].border) {
                const bool held = heldAt_.contains(side);
                patch.held = patch.held || held;
                patch.free = patch.free || (!held && wallsAt_.at(side).second == 1);
            }
            for (const size_t triangle : walls_[w].front) {
                const glm::ivec3 t = welded(triangle);
                patch.volume += glm::dot(place(t.x) - mesh_.low,
                                         glm::cross(place(t.y) - mesh_.low, place(t.z) - mesh_.low));
            }
        }
        for (size_t w = 0; w < walls_.size(); ++w) {
            const Patch& patch = patches[root(w)];
            if (!patch.free && patch.held) continue;
            const bool inwards = !patch.free && patch.volume < 0;
            for (const size_t t : inwards ? walls_[w].back : walls_[w].front)
                gone_[t] = 0;
        }
    }

    const Mesh& mesh_;
    std::vector<char> gone_, inWall_;
    std::vector<Wall> walls_;
    std::vector<size_t> root_;                           // of each wall, towards its patch
    std::map<Edge, std::pair<size_t, size_t>> wallsAt_;  // a wall with this edge, and how many have it
    std::set<Edge> heldAt_;                              // edges of walls that other triangles share
};

}  // namespace

std::vector<char> coincidentTriangles(const Mesh& mesh) {
    return Walls(mesh).run();
}

}  // namespace shoal
